// Reading a JSON table field by field: every fault names file, field, value, allowed range and what to do.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "host/base/json/json.hpp"

namespace liana::config {

// Allowed range of a number, both ends included unless `above` excludes the lower one.
struct Range {
  double low;
  double high;
  bool above = false;  // low itself is not allowed

  // "4..9" or "over 0, up to 9".
  std::string text() const;
  // True for finite values inside.
  bool contains(double value) const;
};

// A place in a JSON table; knows its file and path for messages. Cheap to copy; refers to the JSON, which must outlive
// it.
class Field {
 public:
  Field(const Json& value, std::string file, std::string path)
      : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

  // Throws std::runtime_error "file: path: value: allowed ...: what to do".
  [[noreturn]] void refuse(const std::string& allowed, const std::string& what_to_do) const;

  // The member `key`; refuses when this is no table or has no such member.
  Field at(const std::string& key) const;
  // Element i of an array (0-based; messages count from 1 as Lua does).
  Field element(std::size_t i) const;
  // Number of elements; refuses when this is no array or the number is outside low..high.
  std::size_t size(std::size_t low, std::size_t high, const std::string& what_to_do) const;
  // Refuses members that are not in `known`.
  void only(const std::set<std::string>& known) const;

  double number(const Range& range) const;
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  // Non-empty text of letters, digits, '_', '-' and '.', at most `longest` bytes.
  std::string name(std::size_t longest) const;
  // One of the words.
  std::string choice(const std::vector<std::string>& words) const;
  // Exactly N numbers.
  template <std::size_t N>
  std::array<double, N> numbers(const Range& range) const {
    size(N, N, "give exactly " + std::to_string(N) + " numbers");
    std::array<double, N> out{};
    for (std::size_t i = 0; i < N; ++i) out[i] = element(i).number(range);
    return out;
  }

  const Json& json() const { return *value_; }
  const std::string& file() const { return file_; }

 private:
  const Json* value_;
  std::string file_;
  std::string path_;
};

// Parses `text`; a syntax error becomes a message that names the file and the place, a number that no double holds one
// like that of any other bad number.
Json parse_json(const std::string& text, const std::string& file,
                const std::string& advice = "export the Lua table again with liana-mission eval");

// The whole file as text; throws when it cannot be read.
std::string read_text_file(const std::string& path);

// Checks `format` = 1 and `kind`, which every table begins with; `other` is added to what the message allows.
void check_kind(const Field& table, const std::string& kind, const std::string& other = "");

}  // namespace liana::config
