// Tick deadlines on the monotonic clock.
#pragma once

#include <cstdint>

#include "host/base/clock/tick_start.hpp"

namespace liana::timing {

class TickClock {
 public:
  explicit TickClock(std::uint32_t period_us) noexcept : period_ns_(std::uint64_t{period_us} * 1000) {}

  // Sleeps until the deadline of `tick`, or, when that has passed, until the next one after now. The first call fixes
  // tick 0 so that `tick` begins one period later.
  TickStart wait(std::uint64_t tick) noexcept;
  // Time left until half the period of the running tick has passed [ns], 0 when it has.
  std::uint64_t left_to_half_ns() const noexcept;
  // Time since tick 0 [us]; 0 before it.
  std::uint64_t now_us() const noexcept;

 private:
  std::uint64_t period_ns_;
  std::uint64_t epoch_ns_ = 0;  // of tick 0 on CLOCK_MONOTONIC, 0 = not fixed yet
  std::uint64_t deadline_ns_ = 0;
};

}  // namespace liana::timing
