#include "host/base/json/plain_reader.hpp"

#include <charconv>

namespace liana {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Every function reads one thing from where it stands and goes behind it; false: it is not plain.
class Reader {
 public:
  Reader(std::string_view text, Json::Twice twice) : at_(text.data()), end_(at_ + text.size()), twice_(twice) {}

  bool whole(Json& out) {
    skip_blanks();
    if (!value(out)) return false;
    skip_blanks();
    return at_ == end_;
  }

 private:
  bool value(Json& out) {
    if (at_ == end_) return false;
    switch (*at_) {
      case '{':
        return object(out);
      case '[':
        return array(out);
      case '"': {
        std::string_view plain;
        if (!text(plain)) return false;
        out = Json(plain);
        return true;
      }
      case 't':
        return word("true", true, out);
      case 'f':
        return word("false", false, out);
      case 'n':
        return word("null", nullptr, out);
      default:
        return number(out);
    }
  }

  // From the bracket that opens an object or array to the one that closes it; `item` reads one of what is between.
  template <class Item>
  bool items(char close, const Item& item) {
    ++at_;
    if (++level_ > Json::kMaxLevels) return false;
    if (!next(close)) {
      do {
        skip_blanks();
        if (!item()) return false;
      } while (next(','));
      if (!next(close)) return false;
    }
    --level_;
    return true;
  }

  bool object(Json& out) {
    Json::Object members;
    if (!items('}', [&] { return member(members); })) return false;
    out = Json(std::move(members));
    return true;
  }

  // Members mostly come in their order: behind the last is where to look first.
  bool member(Json::Object& members) {
    std::string_view name;
    if (!text(name) || !next(':')) return false;
    const std::size_t before = members.size();
    const auto place = members.emplace_hint(members.end(), name, Json());
    if (members.size() == before && twice_ == Json::Twice::kRefuse) return false;
    skip_blanks();
    return value(place->second);
  }

  bool array(Json& out) {
    Json::Array entries;
    if (!items(']', [&] { return value(entries.emplace_back()); })) return false;
    out = Json(std::move(entries));
    return true;
  }

  bool text(std::string_view& out) {
    if (at_ == end_ || *at_ != '"') return false;
    const char* const begin = ++at_;
    while (at_ != end_ && *at_ >= 0x20 && *at_ < 0x7f && *at_ != '"' && *at_ != '\\') ++at_;
    if (at_ == end_ || *at_ != '"') return false;
    out = {begin, static_cast<std::size_t>(at_ - begin)};
    ++at_;
    return true;
  }

  // A whole number with a sign is signed, without one unsigned.
  bool number(Json& out) {
    const char* const begin = at_;
    if (at_ != end_ && *at_ == '-') ++at_;
    const char* const whole = at_;
    if (!digits() || (*whole == '0' && at_ - whole > 1)) return false;
    bool is_whole = true;
    if (at_ != end_ && *at_ == '.') {
      is_whole = false;
      ++at_;
      if (!digits()) return false;
    }
    if (at_ != end_ && (*at_ == 'e' || *at_ == 'E')) {
      is_whole = false;
      ++at_;
      if (at_ != end_ && (*at_ == '+' || *at_ == '-')) ++at_;
      if (!digits()) return false;
    }
    if (!is_whole) return converted<double>(begin, out);
    return begin == whole ? converted<std::uint64_t>(begin, out) : converted<std::int64_t>(begin, out);
  }

  bool digits() {
    const char* const begin = at_;
    while (at_ != end_ && is_digit(*at_)) ++at_;
    return at_ != begin;
  }

  template <class Number>
  bool converted(const char* begin, Json& out) {
#ifndef __cpp_lib_to_chars  // a library that reads no fractions (libc++ 14): the other parser does
    if constexpr (std::floating_point<Number>)
      return false;
    else
#endif
    {
      Number number{};
      const auto [stopped, error] = std::from_chars(begin, at_, number);
      if (error != std::errc() || stopped != at_) return false;
      out = Json(number);
      return true;
    }
  }

  template <class Value>
  bool word(std::string_view spelled, Value value, Json& out) {
    if (!std::string_view(at_, end_).starts_with(spelled)) return false;
    at_ += spelled.size();
    out = Json(value);
    return true;
  }

  // The mark that comes next, blanks before it left out; stays where it is when something else comes.
  bool next(char mark) {
    skip_blanks();
    if (at_ == end_ || *at_ != mark) return false;
    ++at_;
    return true;
  }

  void skip_blanks() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\t' || *at_ == '\r')) ++at_;
  }

  const char* at_;
  const char* end_;
  Json::Twice twice_;
  int level_ = 0;
};

}  // namespace

std::optional<Json> read_plain(std::string_view text, Json::Twice twice) {
  Json out;
  if (!Reader(text, twice).whole(out)) return std::nullopt;
  return out;
}

}  // namespace liana
