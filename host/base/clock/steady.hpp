// Now, on a clock that nobody sets.
#pragma once

#include <chrono>
#include <cstdint>

namespace liana::timing {

// Time since an instant that stays the same while the machine runs [s], [us].
inline double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
inline std::int64_t steady_us() {
  using std::chrono::microseconds;
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace liana::timing
