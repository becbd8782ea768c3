// When the last tick began, heard its drives and ended, and what that says about a missed deadline.
#pragma once

#include <cstdint>

#include "host/control/realtime/latency_histogram.hpp"
#include "host/drives/bus/drive_bus.hpp"

namespace liana::realtime {

// Deadlines that were missed, by cause.
struct Overruns {
  std::uint64_t late_wake = 0;   // the thread came late to its deadline
  std::uint64_t long_tick = 0;   // the tick itself took too long
  std::uint64_t bus_wait = 0;    // the bus kept the thread waiting
  std::uint64_t lost_ticks = 0;  // periods skipped because of them
  std::uint64_t total() const { return late_wake + long_tick + bus_wait; }
  // Those since `before` was taken.
  Overruns since(const Overruns& before) const {
    return {late_wake - before.late_wake, long_tick - before.long_tick, bus_wait - before.bus_wait,
            lost_ticks - before.lost_ticks};
  }
};

// All times on the bus's clock [us].
class TickTimes {
 public:
  TickTimes(std::int32_t period_us, TickTiming& timing)
      : period_us_(static_cast<std::uint64_t>(period_us)), timing_(timing) {}

  // A tick begins. Where deadlines were missed, names why: the tick before took too long (its own work, or waiting for
  // the bus), or the thread woke up late.
  void begin(const timing::TickStart& start, std::uint64_t now_us, Overruns& overruns) noexcept;
  // The wait for feedback is over.
  void heard(std::uint64_t now_us) noexcept { heard_us_ = now_us; }
  // The tick has ended, its reports are published.
  void end(const timing::TickStart& start, std::uint64_t now_us) noexcept;

 private:
  std::uint64_t period_us_;
  TickTiming& timing_;
  std::uint64_t began_us_ = 0, heard_us_ = 0, ended_us_ = 0;
};

}  // namespace liana::realtime
