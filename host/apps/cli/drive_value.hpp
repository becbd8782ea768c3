// Values of a drive's objects as people read and write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"
#include "host/drives/commissioning/desk.hpp"

namespace liana::cli {

// What more than four bytes say: text, where all of them are printable but zeros at the end, as some drives fill up
// their names; nothing else goes to a terminal.
std::optional<std::string> text_of(const std::vector<std::uint8_t>& bytes);

// "0x000004D2  1234  (32 bits)", with the negative number where the sign bit is set; text in quotes; else all bytes.
std::string value_text(const commissioning::Answer& answer);
// `bytes`, and `unsigned` and `signed` of up to four of them, `text` of more where they are one.
Json value_json(const commissioning::Answer& answer);

// A whole number that fits into 8, 16 or 32 bits: decimal, of either sign, or hexadecimal as value_text() has it.
// Throws BadInput with what is allowed.
std::int64_t value_of(const std::string& text, std::int64_t bits);

}  // namespace liana::cli
