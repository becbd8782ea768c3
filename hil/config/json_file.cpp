#include "hil/config/json_file.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "hil/config/number_overflow.hpp"

namespace liana::bench {

using nlohmann::json;

struct JsonFile::Document {
  json root;
  const json* find(const std::string& field) const {
    const json::json_pointer pointer(field);
    return root.contains(pointer) ? &root.at(pointer) : nullptr;
  }
};

namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr std::size_t kLongestNumberShown = 60;

std::string range_text(double low, double high) {
  char text[80];
  std::snprintf(text, sizeof text, "allowed is %.15g to %.15g", low, high);
  return text;
}

}  // namespace

JsonFile::JsonFile(std::string path, const std::string& kind)
    : path_(std::move(path)), document_(std::make_unique<Document>()) {
  std::error_code unknown;
  if (std::filesystem::exists(path_, unknown) && !std::filesystem::is_regular_file(path_, unknown))
    throw std::runtime_error(path_ + ": is no ordinary file; check the path");
  std::ifstream stream(path_);
  if (!stream) throw std::runtime_error(path_ + ": cannot be opened; check the path");
  parse({std::istreambuf_iterator<char>(stream), {}});
  if (kind.empty()) return;
  if (text("/kind") != kind)
    fail("/kind", "is \"" + text("/kind") + "\", expected \"" + kind + "\"; pass the right file");
  integer("/format", 1, 1);
}

JsonFile::JsonFile(std::string name) : path_(std::move(name)), document_(std::make_unique<Document>()) {}

JsonFile JsonFile::of_text(std::string name, const std::string& text) {
  JsonFile file(std::move(name));
  file.parse(text);
  return file;
}

void JsonFile::parse(const std::string& content) {
  try {
    document_->root = json::parse(content);
  } catch (const json::out_of_range&) {
    const NumberOverflow found = first_overflow(content);
    fail(found.field,
         "is " + found.number.substr(0, kLongestNumberShown) + "; " + range_text(-kLargest, kLargest) + "; correct it");
  } catch (const json::exception& error) {
    throw std::runtime_error(path_ + ": is not JSON: " + error.what() + "; write it with `liana-mission eval`");
  }
}

JsonFile::JsonFile(JsonFile&&) noexcept = default;
JsonFile::~JsonFile() = default;

void JsonFile::fail(const std::string& field, const std::string& why) const {
  throw std::runtime_error(path_ + ": " + (field.empty() ? "" : field + ": ") + why);
}

double JsonFile::number(const std::string& field, double low, double high) const {
  const json* value = document_->find(field);
  if (value == nullptr) fail(field, "is missing; " + range_text(low, high) + "; add it");
  if (!value->is_number()) fail(field, "is " + value->dump() + ", not a number; " + range_text(low, high));
  const double number = value->get<double>();
  if (!(number >= low && number <= high))
    fail(field, "is " + value->dump() + "; " + range_text(low, high) + "; correct it");
  return number;
}

int JsonFile::integer(const std::string& field, int low, int high) const {
  const double value = number(field, low, high);
  if (value != std::floor(value))
    fail(field, "is " + json(value).dump() + ", not a whole number; " + range_text(low, high));
  return static_cast<int>(value);
}

std::string JsonFile::text(const std::string& field) const {
  const json* value = document_->find(field);
  if (value == nullptr || !value->is_string()) fail(field, "must be a text; add it");
  return value->get<std::string>();
}

std::vector<double> JsonFile::numbers(const std::string& field, std::size_t count, double low, double high) const {
  if (size(field) != count)
    fail(field, "has " + std::to_string(size(field)) + " entries, expected " + std::to_string(count));
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(number(field + "/" + std::to_string(i), low, high));
  return values;
}

Vec3 JsonFile::vector(const std::string& field) const {
  const auto v = numbers(field, 3, -1e3, 1e3);
  return {v[0], v[1], v[2]};
}

Pose JsonFile::pose(const std::string& field) const {
  const auto q = numbers(field + "/quaternion_wxyz", 4, -1.0, 1.0);
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (std::fabs(length - 1.0) > 1e-6)
    fail(field + "/quaternion_wxyz", "has length " + std::to_string(length) + ", allowed is 1 +- 1e-6");
  return {vector(field + "/position_m"), {q[0] / length, q[1] / length, q[2] / length, q[3] / length}};
}

std::size_t JsonFile::size(const std::string& field) const {
  const json* value = document_->find(field);
  if (value == nullptr || !value->is_array()) fail(field, field.empty() ? "must be a list" : "must be a list; add it");
  return value->size();
}

std::vector<std::string> JsonFile::keys(const std::string& field) const {
  const json* value = document_->find(field);
  if (value == nullptr || !value->is_object()) fail(field, "must be a table; add it");
  std::vector<std::string> names;
  for (const auto& item : value->items()) {
    if (item.key().find_first_of("/~") != std::string::npos)  // it could not be found again by its path
      fail(field, "holds the name '" + item.key() + "': a name has neither / nor ~; correct it");
    names.push_back(item.key());
  }
  return names;
}

bool JsonFile::has(const std::string& field) const { return document_->find(field) != nullptr; }

bool JsonFile::is_text(const std::string& field) const { return has(field) && document_->find(field)->is_string(); }

bool JsonFile::is_list(const std::string& field) const { return has(field) && document_->find(field)->is_array(); }

bool JsonFile::is_true(const std::string& field) const { return has(field) && *document_->find(field) == json(true); }

}  // namespace liana::bench
