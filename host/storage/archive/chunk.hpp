// A second of records as one blob, a third of its size and without loss: the 32-bit words that stand at one place of
// each record follow each other, as they are, as differences or as differences of those, whichever is least (numbers
// that go on smoothly differ little); then by bytes, lowest first; then compressed with zstd 1, where the build has it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace liana::archive {

// `records`: one after the other, each of `record_bytes`, which 4 divides.
std::string packed(std::string_view records, std::size_t record_bytes);

// The `count` records again, one after the other. Throws std::runtime_error when the blob is damaged or this build
// cannot read it.
std::string unpacked(std::string_view blob, std::size_t count, std::size_t record_bytes);

}  // namespace liana::archive
