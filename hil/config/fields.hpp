// What the readers of this room share.
#pragma once

#include <cstddef>
#include <numbers>
#include <string>

namespace liana::bench {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

// Of the first simulated drive, where the table has none: 1000 + node id.
inline constexpr std::size_t kFirstSerial = 1001;

// The pointer to element `i` of the list at `list`.
inline std::string at(const std::string& list, std::size_t i) { return list + "/" + std::to_string(i); }

}  // namespace liana::bench
