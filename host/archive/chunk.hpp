// A second of records as one blob: all first bytes, then all second ones, ... (neighbours in time differ little), then
// compressed with zstd 1, where the build has it and it gains something.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace liana::archive {

// `records`: one after the other, each of `record_bytes`.
std::string packed(std::string_view records, std::size_t record_bytes);

// The `count` records again. Throws std::runtime_error when the blob is damaged or this build cannot read it.
std::vector<std::string> unpacked(std::string_view blob, std::size_t count, std::size_t record_bytes);

}  // namespace liana::archive
