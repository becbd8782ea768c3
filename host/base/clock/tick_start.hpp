// How a tick begins, in every way time passes.
#pragma once

#include <cstdint>

namespace liana::timing {

// How a tick began.
struct TickStart {
  std::uint64_t tick = 0;         // the tick that begins now: the one asked for, or a later one after an overrun
  std::uint32_t lateness_us = 0;  // wake-up after the deadline; 0 in virtual time
  std::uint32_t lost_ticks = 0;   // deadlines that had passed already; in virtual time only after a scripted pause
  bool ended = false;             // the other side has left; there will be no further tick
};

}  // namespace liana::timing
