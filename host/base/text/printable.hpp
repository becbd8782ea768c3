// Text from elsewhere (names, logs, tables, the wire) on its way to a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace liana::text {

enum class Lines : std::uint8_t { kOne, kMany };  // kMany: tabs and ends of lines stay

// Bytes of the UTF-8 character that `text` begins with; 0 when it begins with none, or with one that is cut off.
std::size_t character_bytes(std::string_view text);

// The begin of UTF-8 text: as many whole characters as fit into so many bytes.
std::string_view whole_characters(std::string_view text, std::size_t max_bytes);

// The code point of one whole character.
std::uint32_t code_of(std::string_view character);

// Whether a terminal acts on this one character of UTF-8: the controls of ASCII and those from U+0080 to U+009F, marks
// that turn the direction of text (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069), and U+2028, U+2029.
bool is_control(std::string_view character);

// The text with `mark` for every control character, and ? for every byte that is no UTF-8.
std::string printable(std::string_view text, Lines lines, char mark = '?');

// The same of lines that come in pieces: `rest` has the begin of a character that a piece cuts off.
std::string printable_piece(std::string_view piece, std::string& rest);

}  // namespace liana::text
