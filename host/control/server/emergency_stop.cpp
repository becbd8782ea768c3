#include "host/control/server/emergency_stop.hpp"

#include "host/base/json/json.hpp"

namespace liana::server {

namespace {

// Bytes of the UTF-8 character that `text` begins with; 0 when it begins with none.
std::size_t character_bytes(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t bytes = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (first > 0xF4 || bytes > text.size()) return 0;
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0u) != 0x80) return 0;
  }
  if (bytes < 3) return bytes;
  const unsigned second = byte(1);  // neither too long a form, nor a surrogate, nor beyond the last code point
  const bool good = !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second > 0x9F) &&
                    !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F);
  return good ? bytes : 0;
}

bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  return character.size() == 2 && first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    const std::string_view character = text.substr(0, bytes);
    const std::string_view shown = bytes == 0 ? "?" : is_control(character) ? " " : character;
    if (out.size() + shown.size() > kMaxReasonBytes) break;
    out += shown;
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return out;
}

std::string stop_reason(const Json* reason) {
  if (reason == nullptr || reason->is_null()) return "";
  return printable(reason->is_string() ? reason->text() : reason->dump(-1, Json::BadUtf8::kReplace));
}

std::string text_of(const StopOrder& order) {
  return "emergency stop by " + order.by + (order.reason.empty() ? "" : ": " + order.reason);
}

}  // namespace liana::server
