#include "host/model/config/canonical.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "host/base/json/json.hpp"

namespace liana::config {
namespace {

void write(const Json& value, std::string& out);

void write_object(const Json& object, std::string& out) {
  char separator = '{';
  for (const auto& [key, item] : object.items()) {  // Json keeps keys in byte order
    out += separator;
    out += Json(key).dump();
    out += ':';
    write(item, out);
    separator = ',';
  }
  out += object.empty() ? "{}" : "}";
}

void write_array(const Json& array, std::string& out) {
  char separator = '[';
  for (const auto& item : array) {
    out += separator;
    write(item, out);
    separator = ',';
  }
  out += array.empty() ? "[]" : "]";
}

void write(const Json& value, std::string& out) {
  if (value.is_object()) return write_object(value, out);
  if (value.is_array()) return write_array(value, out);
  out += value.is_number() ? canonical_number(value.get<double>()) : value.dump();
}

}  // namespace

std::string canonical_number(double value) {
  constexpr double kExactInteger = 9007199254740992.0;  // 2^53
  if (std::fabs(value) < kExactInteger && value == std::trunc(value))
    return std::to_string(static_cast<std::int64_t>(value));
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

std::string canonical_json(const Json& value) {
  std::string out;
  write(value, out);
  return out;
}

}  // namespace liana::config
