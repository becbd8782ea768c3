// Recorded bytes of a tick as 32-bit words, a field each (two for 8 bytes), which packed() takes; and back.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace liana::archive {

// `widths`: a digit for each field (host/record/field_widths.hpp).
std::size_t bytes_of_fields(std::string_view widths);
std::size_t bytes_of_words(std::string_view widths);

// Appends the words. Throws std::runtime_error when `fields` are not as many bytes as the widths say.
void append_words(std::string& out, std::string_view fields, std::string_view widths);
// The bytes again, from as many words as append_words() made.
std::string fields_of(std::string_view words, std::string_view widths);

}  // namespace liana::archive
