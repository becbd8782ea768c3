// The one file of the host that includes nlohmann/json.hpp: its parser, its way of writing a double and its escapes.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "host/base/json/json.hpp"
#include "host/base/json/number_error.hpp"
#include "host/base/json/plain_reader.hpp"
#include "host/base/text/printable.hpp"

namespace liana {
namespace {

using Library = nlohmann::json;

constexpr int kNumberOverflow = 406;          // the library's number of this error
constexpr std::size_t kLongestMessage = 200;  // the library shows all of a text that does not end

// "[json.exception.parse_error.101] parse error at line ...": the number in brackets says nothing to the reader.
std::string plain(std::string what) {
  const auto end = what.find("] ");
  if (what.starts_with("[json.exception") && end != std::string::npos) what.erase(0, end + 2);
  return what.size() <= kLongestMessage ? what : what.substr(0, kLongestMessage) + "...";
}

// Builds the value from the parser's events; the parser itself needs no stack, and this one counts its levels.
class Builder : public nlohmann::json_sax<Library> {
 public:
  explicit Builder(Json::Twice twice) : twice_(twice) {}

  bool null() override { return add(Json()); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(std::int64_t value) override { return add(value); }
  bool number_unsigned(std::uint64_t value) override { return add(value); }
  bool number_float(double value, const std::string&) override { return add(value); }
  bool string(std::string& value) override { return add(std::move(value)); }
  bool binary(Library::binary_t&) override { return false; }  // not in JSON texts
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override { return close(); }
  bool key(std::string& name) override {
    if (twice_ == Json::Twice::kRefuse && open_.back()->contains(name)) throw JsonTwiceError(name);
    member_ = &(*open_.back())[name];
    return true;
  }
  bool parse_error(std::size_t at, const std::string& token, const Library::exception& error) override {
    if (error.id == kNumberOverflow) throw JsonNumberError(way(), token, at);
    throw JsonParseError(plain(error.what()), at);
  }

  bool too_deep() const { return open_.size() >= Json::kMaxLevels; }
  Json& result() { return result_; }

 private:
  // From the whole to the value that comes next.
  std::vector<JsonNumberError::Step> way() const {
    std::vector<JsonNumberError::Step> steps;
    for (std::size_t level = 0; level < open_.size(); ++level) {
      const bool is_last = level + 1 == open_.size();
      steps.push_back(is_last ? step_to_next(*open_[level]) : step_to(*open_[level], open_[level + 1]));
    }
    return steps;
  }
  JsonNumberError::Step step_to_next(const Json& container) const {
    return container.is_array() ? container.size() : step_to(container, member_);
  }
  static JsonNumberError::Step step_to(const Json& container, const Json* value) {
    if (container.is_array()) return static_cast<std::size_t>(value - container.begin());
    const Json::Object& members = container.items();
    return std::find_if(members.begin(), members.end(), [&](const auto& each) { return &each.second == value; })->first;
  }

  bool add(Json value) {
    place(std::move(value));
    return true;
  }
  // Refuses (false ends the parser) beyond the deepest level.
  bool open(Json container) {
    if (too_deep()) return false;
    open_.push_back(&place(std::move(container)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }
  // Where the next value belongs: the whole, an entry of the innermost array, or the member just named. Pointers to
  // open containers stay good: nothing is added to a container while one inside it is open.
  Json& place(Json value) {
    if (open_.empty()) return result_ = std::move(value);
    if (open_.back()->is_object()) return *member_ = std::move(value);
    open_.back()->push_back(std::move(value));
    return open_.back()->back();
  }

  Json::Twice twice_;
  Json result_;
  std::vector<Json*> open_;
  Json* member_ = nullptr;
};

bool needs_no_escape(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f && c != '"' && c != '\\'; });
}

// Writes one value; recursion is as deep as the value.
class Writer {
 public:
  Writer(int indent, Json::BadUtf8 bad) : indent_(indent), bad_(bad) {}

  void write(const Json& value) {
    if (value.is_object()) return write_object(value.items());
    if (value.is_array()) return write_array(value);
    if (value.is_string()) return write_text(value.text());
    if (value.is_boolean()) out_ += value.get<bool>() ? "true" : "false";
    if (value.is_number()) write_number(value);
    if (value.is_null()) out_ += "null";
  }
  std::string take() { return std::move(out_); }

 private:
  void write_object(const Json::Object& object) {
    out_ += '{';
    ++level_;
    const char* separator = "";
    for (const auto& [name, value] : object) {
      out_ += separator;
      new_line();
      write_text(name);
      out_ += indent_ >= 0 ? ": " : ":";
      write(value);
      separator = ",";
    }
    end('}', object.empty());
  }

  void write_array(const Json& array) {
    out_ += '[';
    ++level_;
    const char* separator = "";
    for (const Json& value : array) {
      out_ += separator;
      new_line();
      write(value);
      separator = ",";
    }
    end(']', array.empty());
  }

  void new_line() {
    if (indent_ < 0) return;
    out_ += '\n';
    out_.append(level_ * static_cast<std::size_t>(indent_), ' ');
  }

  void end(char bracket, bool empty) {
    --level_;
    if (!empty) new_line();
    out_ += bracket;
  }

  void write_number(const Json& value) {
    std::array<char, 64> text{};
    char* const last = text.data() + text.size();
    char* end = text.data();
    if (value.is_number_unsigned()) {
      end = std::to_chars(end, last, value.get<std::uint64_t>()).ptr;
    } else if (value.is_number_integer()) {
      end = std::to_chars(end, last, value.get<std::int64_t>()).ptr;
    } else if (std::isfinite(value.get<double>())) {
      end = nlohmann::detail::to_chars(end, last, value.get<double>());
    } else {
      out_ += "null";
    }
    out_.append(text.data(), end);
  }

  void write_text(const std::string& text) {
    if (!needs_no_escape(text)) return write_escaped(text);
    out_ += '"';
    out_ += text;
    out_ += '"';
  }

  void write_escaped(const std::string& text) {
    const bool replace = bad_ == Json::BadUtf8::kReplace;
    try {
      add_visible(Library(text).dump(-1, ' ', false,
                                     replace ? Library::error_handler_t::replace : Library::error_handler_t::strict));
    } catch (const Library::exception& error) {
      throw JsonError(plain(error.what()));
    }
  }

  // Controls beyond those of ASCII as \u: whoever shows the text on a terminal shows nothing that it acts on.
  void add_visible(std::string_view dumped) {
    const auto is_plain = [](unsigned char c) { return c >= 0x20 && c < 0x7F; };
    if (std::all_of(dumped.begin(), dumped.end(), is_plain)) {  // nearly every text
      out_ += dumped;
      return;
    }
    while (!dumped.empty()) {
      const std::string_view character = dumped.substr(0, std::max<std::size_t>(1, text::character_bytes(dumped)));
      dumped.remove_prefix(character.size());
      if (text::is_control(character)) {
        std::array<char, 12> code{};
        std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(text::code_of(character)));
        out_ += code.data();
      } else {
        out_ += character;
      }
    }
  }

  int indent_;
  Json::BadUtf8 bad_;
  std::size_t level_ = 0;
  std::string out_;
};

}  // namespace

Json Json::parse(std::string_view text, Twice twice) {
  if (std::optional<Json> plain = read_plain(text, twice)) return std::move(*plain);
  // The library takes a zero byte for the end of the text and would accept whatever follows it.
  if (const auto zero = text.find('\0'); zero != text.npos) {
    throw JsonParseError("parse error: byte " + std::to_string(zero + 1) + " is zero", zero + 1);
  }
  Builder builder(twice);
  if (Library::sax_parse(text, &builder)) return std::move(builder.result());
  throw JsonParseError("nested deeper than " + std::to_string(kMaxLevels) + " levels", 0);
}

Json Json::parse_or_null(std::string_view text) {
  try {
    return parse(text);
  } catch (const JsonParseError&) {
    return {};
  }
}

std::string Json::dump(int indent, BadUtf8 bad) const {
  Writer writer(indent, bad);
  writer.write(*this);
  return writer.take();
}

}  // namespace liana
