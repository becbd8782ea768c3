// What a number of a device may be.
#pragma once

#include <cmath>
#include <cstdint>

namespace liana::device {

constexpr double kRoom_m = 10.0;                        // a device frame's size, each way
constexpr std::int64_t kMaxTime_us = 9007199254740992;  // 2^53: a double holds every whole number up to it

// Finite, not denormal, and at most `most` in size.
inline bool tensions_valid(double value, double most) {
  return (value == 0.0 || std::isnormal(value)) && std::fabs(value) <= most;
}

}  // namespace liana::device
