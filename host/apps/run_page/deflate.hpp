// Compression that every browser undoes by itself, and bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace liana::run_page {

// Raw deflate (RFC 1951), zlib's level 7: the last two cost much and gain little. Throws std::runtime_error when there
// is no memory.
std::string deflated(std::string_view bytes);

// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace liana::run_page
