#include "host/base/json/json.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

namespace liana {
namespace {

constexpr std::size_t kLongestValueShown = 60;

const Json& null_value() {
  static const Json value;
  return value;
}

bool is_pair_with_name(const JsonItem& item) {
  const Json& value = item.look();
  return value.is_array() && value.size() == 2 && value[0].is_string();
}

}  // namespace

Json::Json() noexcept = default;
Json::Json(std::nullptr_t) noexcept {}
Json::Json(Plain, bool value) noexcept : value_(value) {}
Json::Json(Plain, std::int64_t value) noexcept : value_(value) {}
Json::Json(Plain, std::uint64_t value) noexcept : value_(value) {}
Json::Json(Plain, double value) noexcept : value_(value) {}
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(std::string text) noexcept : value_(std::move(text)) {}
Json::Json(std::string_view text) : value_(std::string(text)) {}
Json::Json(Array array) noexcept : value_(std::move(array)) {}
Json::Json(Object object) noexcept : value_(std::move(object)) {}
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<JsonItem> list)
    : Json(std::all_of(list.begin(), list.end(), is_pair_with_name) ? object(list) : array(list)) {}

Json Json::array() { return Json(Array()); }

Json Json::array(std::initializer_list<JsonItem> list) {
  Array out;
  out.reserve(list.size());
  for (const JsonItem& item : list) out.push_back(item.take());
  return Json(std::move(out));
}

Json Json::object() { return Json(Object()); }

Json Json::object(std::initializer_list<JsonItem> list) {
  Object out;
  for (const JsonItem& item : list) {
    if (!is_pair_with_name(item)) item.look().refuse("a pair of a name and a value");
    Json pair = item.take();
    out.emplace(pair[0].text(), std::move(pair[1]));
  }
  return Json(std::move(out));
}

void Json::refuse(const char* wanted) const {
  const std::string found = dump(-1, BadUtf8::kReplace);
  const bool is_short = found.size() <= kLongestValueShown;
  throw JsonError((is_short ? found : found.substr(0, kLongestValueShown) + "...") + " where " + wanted + " belongs");
}

bool Json::get_boolean() const {
  const bool* value = std::get_if<bool>(&value_);
  if (value == nullptr) refuse("true or false");
  return *value;
}

bool Json::is_negative() const noexcept {
  const auto* value = std::get_if<std::int64_t>(&value_);
  return value != nullptr && *value < 0;
}

double Json::get_number() const {
  if (const auto* value = std::get_if<double>(&value_)) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*value);
  if (const auto* value = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*value);
  refuse("a number");
}

std::int64_t Json::get_signed(std::int64_t low, std::int64_t high) const {
  constexpr double kTwoTo63 = 9223372036854775808.0;
  if (const auto* value = std::get_if<std::int64_t>(&value_); value != nullptr && *value >= low && *value <= high)
    return *value;
  if (const auto* value = std::get_if<std::uint64_t>(&value_); value != nullptr && std::cmp_less_equal(*value, high)) {
    return static_cast<std::int64_t>(*value);
  }
  if (const auto* value = std::get_if<double>(&value_); value != nullptr && *value >= -kTwoTo63 && *value < kTwoTo63) {
    const auto whole = static_cast<std::int64_t>(*value);
    if (whole >= low && whole <= high) return whole;
  }
  refuse(("a number from " + std::to_string(low) + " to " + std::to_string(high)).c_str());
}

std::uint64_t Json::get_unsigned(std::uint64_t high) const {
  constexpr double kTwoTo64 = 18446744073709551616.0;
  if (const auto* value = std::get_if<std::uint64_t>(&value_); value != nullptr && *value <= high) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&value_)) {
    if (*value >= 0 && static_cast<std::uint64_t>(*value) <= high) return static_cast<std::uint64_t>(*value);
  }
  if (const auto* value = std::get_if<double>(&value_); value != nullptr && *value > -1.0 && *value < kTwoTo64) {
    const auto whole = static_cast<std::uint64_t>(*value);
    if (whole <= high) return whole;
  }
  refuse(("a number from 0 to " + std::to_string(high)).c_str());
}

const std::string& Json::text() const {
  const auto* value = std::get_if<std::string>(&value_);
  if (value == nullptr) refuse("a text");
  return *value;
}

const Json::Array& Json::entries() const {
  static const Array kNone;
  if (is_null()) return kNone;
  const auto* value = std::get_if<Array>(&value_);
  if (value == nullptr) refuse("an array");
  return *value;
}

const Json::Object& Json::items() const {
  static const Object kNone;
  if (is_null()) return kNone;
  const auto* value = std::get_if<Object>(&value_);
  if (value == nullptr) refuse("an object");
  return *value;
}

std::size_t Json::size() const noexcept {
  if (is_null()) return 0;
  if (const auto* array = std::get_if<Array>(&value_)) return array->size();
  if (const auto* object = std::get_if<Object>(&value_)) return object->size();
  return 1;
}

Json& Json::member_made(std::string_view key) {
  if (is_null()) value_ = Object();
  auto* object = std::get_if<Object>(&value_);
  if (object == nullptr) refuse("an object");
  const auto found = object->find(key);
  return found != object->end() ? found->second : (*object)[std::string(key)];
}

const Json* Json::find(std::string_view key) const {
  const auto* object = std::get_if<Object>(&value_);
  if (object == nullptr) return nullptr;
  const auto found = object->find(key);
  return found != object->end() ? &found->second : nullptr;
}

Json* Json::find(std::string_view key) { return const_cast<Json*>(std::as_const(*this).find(key)); }

const Json* Json::member_of_object(std::string_view key) const {
  if (!is_object()) refuse(("an object with member \"" + std::string(key) + "\"").c_str());
  return find(key);
}

const Json& Json::at(std::string_view key) const {
  const Json* found = member_of_object(key);
  if (found == nullptr) throw JsonError("member \"" + std::string(key) + "\" is missing");
  return *found;
}

Json& Json::at(std::string_view key) { return const_cast<Json&>(std::as_const(*this).at(key)); }

const Json& Json::member_or_null(std::string_view key) const {
  const Json* found = find(key);
  return found != nullptr ? *found : null_value();
}

const Json& Json::entry(std::size_t i) const {
  if (!is_array()) refuse("an array");
  const Array& array = entries();
  if (i >= array.size())
    throw JsonError("entry " + std::to_string(i) + " of an array of " + std::to_string(array.size()));
  return array[i];
}

Json& Json::entry(std::size_t i) { return const_cast<Json&>(std::as_const(*this).entry(i)); }

const Json* Json::begin() const { return entries().data(); }
const Json* Json::end() const { return entries().data() + entries().size(); }
Json* Json::begin() { return const_cast<Json*>(std::as_const(*this).begin()); }
Json* Json::end() { return const_cast<Json*>(std::as_const(*this).end()); }

void Json::push_back(Json value) {
  if (is_null()) value_ = Array();
  auto* array = std::get_if<Array>(&value_);
  if (array == nullptr) refuse("an array");
  array->push_back(std::move(value));
}

void Json::push_back(std::initializer_list<JsonItem> list) { push_back(Json(list)); }

void Json::erase(std::string_view key) {
  auto* object = std::get_if<Object>(&value_);
  if (object == nullptr) refuse("an object");
  if (const auto found = object->find(key); found != object->end()) object->erase(found);
}

void Json::erase(std::size_t i) {
  entry(i);  // refuses what is not there
  auto& array = std::get<Array>(value_);
  array.erase(array.begin() + static_cast<std::ptrdiff_t>(i));
}

bool operator==(const Json& a, const Json& b) {
  if (!a.is_number() || !b.is_number()) return a.value_ == b.value_;
  if (a.is_number_float() || b.is_number_float()) return a.get_number() == b.get_number();
  if (a.is_negative() != b.is_negative()) return false;
  return a.is_negative() ? a.get<std::int64_t>() == b.get<std::int64_t>()
                         : a.get<std::uint64_t>() == b.get<std::uint64_t>();
}

std::ostream& operator<<(std::ostream& out, const Json& value) {
  return out << value.dump(-1, Json::BadUtf8::kReplace);
}

}  // namespace liana
