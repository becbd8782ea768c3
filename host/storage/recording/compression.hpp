// Compression of the chunks of a recording: zstd where the build has it (libzstd-dev), none elsewhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace liana::recording {

// Name of what compress() does, as MCAP spells it: "zstd", or "" for none.
const char* compression_name();

// The bytes of a chunk as a file holds them. The same bytes in, with the same library, give the same bytes out. `level`
// as zstd has it: a tick's 1.5 kB take 5 us at 3; higher ones gain little.
std::string compress(std::string_view plain, int level = 3);

// Back again, `size` bytes. Throws std::runtime_error when the bytes are damaged, are compressed with something that
// this build does not know, or are not `size` bytes.
std::string decompress(std::string_view compressed, std::string_view compression, std::uint64_t size);

}  // namespace liana::recording
