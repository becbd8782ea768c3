// One JSON value, kept cheap to include: the library that parses and prints is in json_text.cpp alone.
// The interface is the part of nlohmann::json that is used here, and dump() prints the same bytes.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace liana {

class Json;
class JsonItem;

// A value of another type than asked for, a missing member, a number out of range, or a text that is no UTF-8.
struct JsonError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A text that is no JSON; what() says line, column and what was expected. Or JsonNumberError (number_error.hpp).
struct JsonParseError : JsonError {
  JsonParseError(const std::string& what, std::size_t at) : JsonError(what), byte(at) {}
  std::size_t byte;  // where reading ended, counted from 1; 0 for a text that is nested too deep
};

// A member that is given twice in one object (Json::Twice::kRefuse).
struct JsonTwiceError : JsonError {
  explicit JsonTwiceError(const std::string& name) : JsonError("member \"" + name + "\" is given twice"), key(name) {}
  std::string key;
};

// What get<T>() reads besides Json itself: truth, numbers, texts, and lists of these.
template <class T>
struct JsonReads : std::bool_constant<std::is_arithmetic_v<T> && !std::same_as<T, char>> {};
template <>
struct JsonReads<std::string> : std::true_type {};
template <class T>
struct JsonReads<std::vector<T>> : JsonReads<T> {};
template <class T, std::size_t N>
struct JsonReads<std::array<T, N>> : JsonReads<T> {};
template <class T>
concept JsonReadable = JsonReads<T>::value;

// Lists of the standard library that become arrays, and maps that become objects.
template <class T>
concept JsonMap = requires {
  typename T::mapped_type;
};
template <class T>
concept JsonList = !JsonMap<T> && !std::convertible_to<T, std::string_view> && !std::convertible_to<T, std::string> &&
                   requires(const T& list) {
  typename T::value_type;
  list.begin();
  list.end();
};

// A value: null, true or false, a whole number (signed or unsigned, 64 bits), a number, a text (UTF-8), an array, or an
// object, whose members are kept in byte order of their names. References to members stay good while others are added.
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::map<std::string, Json, std::less<>>;

  // Deepest nesting that parse() accepts: one more is an error, so that no text can exhaust the stack.
  static constexpr int kMaxLevels = 200;
  enum class Twice { kLastCounts, kRefuse };  // a member that is given twice
  enum class BadUtf8 { kRefuse, kReplace };   // by U+FFFD

  Json() noexcept;  // null
  Json(std::nullptr_t) noexcept;
  template <std::same_as<bool> T>
  Json(T value) noexcept : Json(Plain(), value) {}
  template <std::signed_integral T>
  requires(!std::same_as<T, char>) Json(T value)
  noexcept : Json(Plain(), static_cast<std::int64_t>(value)) {}
  template <std::unsigned_integral T>
  requires(!std::same_as<T, bool>) Json(T value)
  noexcept : Json(Plain(), static_cast<std::uint64_t>(value)) {}
  template <std::floating_point T>
  Json(T value) noexcept : Json(Plain(), static_cast<double>(value)) {}
  Json(const char* text);
  Json(std::string text) noexcept;
  Json(std::string_view text);
  Json(Array array) noexcept;
  Json(Object object) noexcept;
  template <JsonList T>
  Json(const T& list) : Json(Array()) {
    for (const auto& each : list) push_back(Json(each));
  }
  template <JsonMap T>
  Json(const T& map) : Json(Object()) {
    for (const auto& [key, each] : map) (*this)[key] = Json(each);
  }
  // A braced list: an object when every entry is a pair that begins with a text, else an array.
  Json(std::initializer_list<JsonItem> list);
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  static Json array();
  static Json array(std::initializer_list<JsonItem> list);
  static Json object();
  // Throws JsonError when an entry is no pair that begins with a text.
  static Json object(std::initializer_list<JsonItem> list);

  // Reads one value (RFC 8259, strict UTF-8). Throws JsonParseError, also beyond kMaxLevels, and JsonTwiceError. Time
  // and memory grow with the text: the caller bounds its size.
  static Json parse(std::string_view text, Twice twice = Twice::kLastCounts);
  // The same; null for a text that is no JSON.
  static Json parse_or_null(std::string_view text);
  // The value as text: on one line without spaces, or on many, indented by `indent` each level. Numbers that are not
  // finite become null. Throws JsonError where a text is no UTF-8, unless it is to be replaced.
  std::string dump(int indent = -1, BadUtf8 bad = BadUtf8::kRefuse) const;

  bool is_null() const noexcept { return std::holds_alternative<std::monostate>(value_); }
  bool is_boolean() const noexcept { return std::holds_alternative<bool>(value_); }
  bool is_number() const noexcept { return is_number_integer() || is_number_float(); }
  bool is_number_integer() const noexcept {
    return std::holds_alternative<std::int64_t>(value_) || is_number_unsigned();
  }
  // A whole number that was read without a sign or made from an unsigned type.
  bool is_number_unsigned() const noexcept { return std::holds_alternative<std::uint64_t>(value_); }
  bool is_number_float() const noexcept { return std::holds_alternative<double>(value_); }
  bool is_string() const noexcept { return std::holds_alternative<std::string>(value_); }
  bool is_array() const noexcept { return std::holds_alternative<Array>(value_); }
  bool is_object() const noexcept { return std::holds_alternative<Object>(value_); }

  // The value as T. Throws JsonError when it is of another kind or a number outside T; fractions are cut off for whole
  // T.
  template <class T>
  T get() const {
    static_assert(std::same_as<T, Json> || JsonReadable<T>);
    T out{};
    read(out);
    return out;
  }
  template <JsonReadable T>
  operator T() const {
    return get<T>();
  }
  // The text itself. Throws JsonError when this is none.
  const std::string& text() const;

  // Entries of an array or members of an object; 0 for null, 1 for any other value.
  std::size_t size() const noexcept;
  bool empty() const noexcept { return size() == 0; }

  // The member `key`, made (null) when there is none yet; null becomes an object. Throws JsonError when this is no
  // object.
  Json& operator[](const char* key) { return member_made(key); }
  Json& operator[](const std::string& key) { return member_made(key); }
  // The member that must be there. Throws JsonError when it is missing.
  const Json& operator[](const char* key) const { return at(key); }
  const Json& operator[](const std::string& key) const { return at(key); }
  Json& at(std::string_view key);
  const Json& at(std::string_view key) const;
  // The entry `i` of an array, from 0. Throws JsonError when there is none.
  template <std::integral I>
  Json& operator[](I i) {
    return entry(static_cast<std::size_t>(i));
  }
  template <std::integral I>
  const Json& operator[](I i) const {
    return entry(static_cast<std::size_t>(i));
  }
  // The member `key`, or nullptr; also in what is no object.
  Json* find(std::string_view key);
  const Json* find(std::string_view key) const;
  bool contains(std::string_view key) const { return find(key) != nullptr; }
  // The member `key`, or null; also in what is no object: so paths can be followed without questions.
  const Json& member_or_null(std::string_view key) const;
  // The member `key`, or `fallback` when there is none. Throws JsonError when this is no object or the member is no T.
  template <class T>
  T value(std::string_view key, T fallback) const {
    const Json* found = member_of_object(key);
    return found != nullptr ? found->get<T>() : fallback;
  }
  std::string value(std::string_view key, const char* fallback) const { return value<std::string>(key, fallback); }

  // The entries of an array; null has none. Throw JsonError for any other value.
  Json* begin();
  Json* end();
  const Json* begin() const;
  const Json* end() const;
  // First and last entry of an array. Throw JsonError when there is none.
  Json& front() { return entry(0); }
  const Json& front() const { return entry(0); }
  Json& back() { return entry(size() - 1); }
  const Json& back() const { return entry(size() - 1); }
  // Names and values of an object, in byte order; null has none. Throws JsonError for any other value.
  const Object& items() const;

  // Adds an entry; null becomes an array. Throws JsonError when this is neither.
  void push_back(Json value);
  void push_back(std::initializer_list<JsonItem> list);
  // Takes a member away, if there is one. Throws JsonError when this is no object.
  void erase(std::string_view key);
  // Takes the entry `i` away. Throws JsonError when there is none.
  void erase(std::size_t i);

  // Numbers compare by value: whole ones exactly, others as double.
  friend bool operator==(const Json& a, const Json& b);
  template <class T>
  requires(!std::same_as<T, Json> && std::constructible_from<Json, const T&>) friend bool operator==(const Json& a,
                                                                                                     const T& b) {
    return a == Json(b);
  }

 private:
  // Construction is not inline: it is the dearest part to compile.
  struct Plain {};
  Json(Plain, bool value) noexcept;
  Json(Plain, std::int64_t value) noexcept;
  Json(Plain, std::uint64_t value) noexcept;
  Json(Plain, double value) noexcept;

  [[noreturn]] void refuse(const char* wanted) const;
  const Array& entries() const;
  Json& entry(std::size_t i);
  const Json& entry(std::size_t i) const;
  Json& member_made(std::string_view key);
  const Json* member_of_object(std::string_view key) const;
  bool is_negative() const noexcept;  // a whole number below 0
  bool get_boolean() const;
  double get_number() const;
  std::int64_t get_signed(std::int64_t low, std::int64_t high) const;
  std::uint64_t get_unsigned(std::uint64_t high) const;

  void read(Json& out) const { out = *this; }
  void read(bool& out) const { out = get_boolean(); }
  void read(std::string& out) const { out = text(); }
  template <std::floating_point T>
  void read(T& out) const {
    out = static_cast<T>(get_number());
  }
  template <std::signed_integral T>
  void read(T& out) const {
    out = static_cast<T>(get_signed(std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
  }
  template <std::unsigned_integral T>
  void read(T& out) const {
    out = static_cast<T>(get_unsigned(std::numeric_limits<T>::max()));
  }
  template <class T>
  void read(std::vector<T>& out) const {
    if (!is_array()) refuse("an array");
    for (const Json& each : *this) out.push_back(each.get<T>());
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& out) const {
    if (!is_array() || size() != N) refuse(("an array of " + std::to_string(N)).c_str());
    for (std::size_t i = 0; i < N; ++i) out[i] = (*this)[i].get<T>();
  }

  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object> value_;
};

// One entry of a braced list; the compiler makes these, so that values move into their place instead of being copied.
class JsonItem {
 public:
  JsonItem() = default;
  JsonItem(const Json& value) : referred_(&value) {}
  JsonItem(Json&& value) noexcept : owned_(std::move(value)) {}
  JsonItem(std::initializer_list<JsonItem> list) : owned_(list) {}
  template <class T>
  requires(!std::same_as<std::remove_cvref_t<T>, JsonItem> && !std::same_as<std::remove_cvref_t<T>, Json> &&
           std::constructible_from<Json, T>) JsonItem(T&& value)
      : owned_(std::forward<T>(value)) {}

  const Json& look() const { return referred_ != nullptr ? *referred_ : owned_; }
  // Moves the value out, or copies what it refers to; once.
  Json take() const {
    if (referred_ != nullptr) return *referred_;
    return std::move(owned_);  // in one expression with the copy, clang copies here, too
  }

 private:
  mutable Json owned_;
  const Json* referred_ = nullptr;
};

// One line, for messages of tests.
std::ostream& operator<<(std::ostream& out, const Json& value);

}  // namespace liana
