// SHA-256 (FIPS 180-4), for configuration hashes.
#pragma once

#include <string>
#include <string_view>

namespace liana::config {

// SHA-256 of the bytes of `text` as 64 lower-case hex digits.
std::string sha256_hex(std::string_view text);

}  // namespace liana::config
