#include "host/base/text/printable.hpp"

#include <utility>

namespace liana::text {
namespace {

constexpr std::size_t kLongestCharacter = 4;

bool is_in(std::uint32_t code, std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; }

// Whether more bytes could make a character of this.
bool is_cut_off(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t bytes = first < 0xC2 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 1;
  return text.size() < bytes;
}

}  // namespace

std::uint32_t code_of(std::string_view character) {
  const auto byte = [character](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  const std::size_t bytes = character.size();
  std::uint32_t code = bytes == 1 ? byte(0) : byte(0) & (0xFFu >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) code = code << 6 | (byte(i) & 0x3Fu);
  return code;
}

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

std::string_view whole_characters(std::string_view text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) return text;
  std::size_t bytes = max_bytes;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0u) == 0x80) --bytes;
  return text.substr(0, bytes);
}

bool is_control(std::string_view character) {
  const std::uint32_t code = code_of(character);
  return code < 0x20 || is_in(code, 0x7F, 0x9F) || code == 0x61C || is_in(code, 0x200E, 0x200F) ||
         is_in(code, 0x2028, 0x202E) || is_in(code, 0x2066, 0x2069);
}

std::string printable(std::string_view text, Lines lines, char mark) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    const std::string_view character = text.substr(0, bytes);
    const bool stays = lines == Lines::kMany && (character == "\n" || character == "\t");
    if (bytes == 0) {
      out += '?';
    } else if (!stays && is_control(character)) {
      out += mark;
    } else {
      out += character;
    }
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return out;
}

std::string printable_piece(std::string_view piece, std::string& rest) {
  std::string whole = std::move(rest);
  whole += piece;
  rest.clear();
  for (std::size_t back = 1; back < kLongestCharacter && back <= whole.size(); ++back) {
    const std::string_view end = std::string_view(whole).substr(whole.size() - back);
    if ((static_cast<unsigned char>(end[0]) & 0xC0u) == 0x80) continue;
    if (is_cut_off(end)) {
      rest = end;
      whole.erase(whole.size() - back);
    }
    break;
  }
  return printable(whole, Lines::kMany);
}

}  // namespace liana::text
