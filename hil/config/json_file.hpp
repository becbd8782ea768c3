// A JSON file read field by field; every complaint names file, field, value, allowed range and what to do.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "hil/math/vec3.hpp"

namespace liana::bench {

class JsonFile {
 public:
  // Reads and parses; throws std::runtime_error when the file cannot be read, is no JSON, or its "kind" is not `kind`
  // (empty: not asked).
  JsonFile(std::string path, const std::string& kind);
  // The same of a text that came otherwise; `name` is what complaints call it.
  static JsonFile of_text(std::string name, const std::string& text);
  ~JsonFile();
  JsonFile(JsonFile&&) noexcept;
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;

  // Fields are JSON pointers, e.g. "/cables/EA_N". All of these throw std::runtime_error when a field is missing, of
  // the wrong type or out of range.
  double number(const std::string& field, double low, double high) const;
  int integer(const std::string& field, int low, int high) const;
  std::string text(const std::string& field) const;
  std::vector<double> numbers(const std::string& field, std::size_t count, double low, double high) const;
  Vec3 vector(const std::string& field) const;
  Pose pose(const std::string& field) const;  // object with position_m and quaternion_wxyz
  std::size_t size(const std::string& field) const;
  std::vector<std::string> keys(const std::string& field) const;
  bool has(const std::string& field) const;
  bool is_text(const std::string& field) const;
  bool is_list(const std::string& field) const;
  bool is_true(const std::string& field) const;  // the value true itself

  // The exception all complaints about this file use.
  [[noreturn]] void fail(const std::string& field, const std::string& why) const;

 private:
  struct Document;
  explicit JsonFile(std::string name);
  void parse(const std::string& content);

  std::string path_;
  std::unique_ptr<Document> document_;
};

}  // namespace liana::bench
