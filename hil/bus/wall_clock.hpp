// The monotonic clock; only for buses in real time and for reporting.
#pragma once

#include <chrono>
#include <cstdint>

namespace liana::bench {

inline std::uint64_t wall_clock_us() {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now().time_since_epoch())
          .count());
}

}  // namespace liana::bench
