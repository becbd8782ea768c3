// Text from elsewhere on its way to a terminal.
#include "host/base/text/printable.hpp"

#include <gtest/gtest.h>

namespace liana::text {
namespace {

std::string encoded(std::uint32_t code) {
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | code >> 6), byte(0x80 | (code & 0x3F))};
  return {byte(0xE0 | code >> 12), byte(0x80 | (code >> 6 & 0x3F)), byte(0x80 | (code & 0x3F))};
}

TEST(Printable, LeavesNoCharacterThatATerminalActsOnAndEveryOther) {
  for (std::uint32_t code = 0; code < 0x3000; ++code) {
    const bool acts = code < 0x20 || (code >= 0x7F && code <= 0x9F) || code == 0x61C || code == 0x200E ||
                      code == 0x200F || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
    const std::string text = "a" + encoded(code) + "b";
    EXPECT_EQ(printable(text, Lines::kOne), acts ? "a?b" : text) << code;
    const bool is_line = code == '\n' || code == '\t';
    EXPECT_EQ(printable(text, Lines::kMany, '_'), acts && !is_line ? "a_b" : text) << code;
  }
}

TEST(Printable, WhatIsNoUtf8IsAQuestionMarkAByte) {
  EXPECT_EQ(printable("\x9b\xff\xc0\xaf\xed\xa0\x80\xe2\x82", Lines::kMany), "?????????");
  EXPECT_EQ(printable("", Lines::kOne), "");
}

TEST(WholeCharacters, AreAsManyAsFitAndNoPartOfOne) {
  const std::string text = "a\xc3\xa9\xf0\x9f\x90\x8d";  // of 1, 2 and 4 bytes
  const std::size_t fit[] = {0, 1, 1, 3, 3, 3, 3, 7, 7};
  for (std::size_t bytes = 0; bytes < 9; ++bytes) EXPECT_EQ(whole_characters(text, bytes), text.substr(0, fit[bytes]));
}

TEST(Printable, InPiecesIsTheSameAsWhole) {
  const std::string text = "caf\xc3\xa9 \xe2\x80\xae\xc2\x9b 12\xc2\xb0 \xf0\x9f\x90\x8d\x1b[2J\xe2\x80";
  for (std::size_t bytes = 1; bytes < text.size(); ++bytes) {
    std::string rest, out;
    for (std::size_t at = 0; at < text.size(); at += bytes) out += printable_piece(text.substr(at, bytes), rest);
    EXPECT_EQ(out + std::string(rest.size(), '?'), printable(text, Lines::kMany)) << bytes;
  }
}

}  // namespace
}  // namespace liana::text
