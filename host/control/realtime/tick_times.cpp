#include "host/control/realtime/tick_times.hpp"

namespace liana::realtime {

void TickTimes::begin(const timing::TickStart& start, std::uint64_t now_us, Overruns& overruns) noexcept {
  const std::uint64_t waited_us = heard_us_ - began_us_, took_us = ended_us_ - began_us_;
  began_us_ = now_us;
  if (start.lost_ticks == 0) return;
  overruns.lost_ticks += start.lost_ticks;
  if (took_us < period_us_) {
    ++overruns.late_wake;
  } else if (waited_us > period_us_ / 2 + period_us_ / 4) {
    ++overruns.bus_wait;
  } else {
    ++overruns.long_tick;
  }
}

void TickTimes::end(const timing::TickStart& start, std::uint64_t now_us) noexcept {
  ended_us_ = now_us;
  timing_.wakeup_us.record(start.lateness_us);
  timing_.tick_us.record(static_cast<std::uint32_t>(ended_us_ - heard_us_));
}

}  // namespace liana::realtime
