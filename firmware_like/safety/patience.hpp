// How long each phase of the supervisor lasts, at least or at most: given in seconds, the same at every rate.
#pragma once

#include <cstdint>
#include <limits>

namespace liana {

// Whole ticks in `time_s` (at most a day), at least one.
constexpr std::uint32_t ticks_in(double time_s, double tick_s) noexcept {
  const auto ticks = static_cast<std::uint32_t>(time_s / tick_s + 0.5);
  return ticks < 1 ? 1 : ticks;
}

// All in ticks.
struct Patience {
  std::uint32_t none = 0;
  std::uint32_t forever = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t powering = 0;   // CiA 402 transitions of one step of enabling, and brakes
  std::uint32_t preparing = 0;  // the ramp takes a few seconds
  std::uint32_t rest = 0;       // standing still this long before the brakes close
  std::uint32_t persist = 0;  // a cause that stays this long turns a hold into a stop; counted anew after each tick in
                              // which a retract moves the arm
  std::uint32_t path_stop = 0;  // full speed to rest takes about 1 s
  std::uint32_t braking = 0;    // brakes closed this long before power goes
  std::uint32_t quick_stop = 0;
  std::uint32_t off = 0;  // disable voltage is sent for at least so many ticks
  std::uint32_t off_budget = 0;
  std::uint32_t reset = 0;  // fault reset edges, and time for the drives to answer
  std::uint32_t reset_budget = 0;
};

constexpr std::uint32_t kOffTicks = 3;     // commands, not time: one may be lost
constexpr std::uint32_t kResetTicks = 10;  // edges

constexpr Patience patience(double tick_s) noexcept {
  Patience ticks;
  ticks.powering = ticks_in(1.0, tick_s);
  ticks.preparing = ticks_in(60.0, tick_s);
  ticks.rest = ticks_in(0.1, tick_s);
  ticks.persist = ticks_in(5.0, tick_s);
  ticks.path_stop = ticks_in(4.0, tick_s);
  ticks.braking = ticks_in(0.1, tick_s);
  ticks.quick_stop = ticks_in(0.5, tick_s);
  ticks.off = kOffTicks;
  ticks.off_budget = ticks_in(1.0, tick_s);
  ticks.reset = kResetTicks;
  ticks.reset_budget = ticks_in(1.0, tick_s);
  return ticks;
}

}  // namespace liana
