#include "firmware_like/cable/arm/tension_monitor.hpp"

namespace liana::cable {

TensionWatchLimits make_tension_watch_limits(const RobotParams& table) noexcept {
  TensionWatchLimits limits{};
  limits.slack_N = table.tension.floor_anywhere_N;
  limits.firm_N = kBreakShare * table.tension.floor_motor_N;
  limits.alarm_N = table.tension.alarm_N;
  limits.hard_limit_N = table.tension.hard_limit_N;
  return limits;
}

void watch_doubtful_tension(const TensionWatchLimits& limits, WatchScope scope, const TensionReading& now,
                            std::int32_t index, TensionMonitorState& state, Watch& out) noexcept {
  const std::size_t i = as_index(index);
  const bool slack = scope.prepared && !(now.tension_N >= limits.slack_N);  // so written, NaN is slack
  out.debounced(slack, kSlackDebounceTicks, state.slack_ticks[i], FaultNumber::kCableSlack, index);
  const bool broken = state.slack_ticks[i] == kBreakDebounceTicks && is_missed(limits, now);
  if (broken) out.wrong(FaultNumber::kCableBreak, index, 0);
  const bool alarm = scope.powered && now.tension_N > limits.alarm_N;
  out.debounced(alarm, kAlarmDebounceTicks, state.alarm_ticks[i], FaultNumber::kTensionAlarm, index);
  const bool overload = scope.powered && now.tension_N > limits.hard_limit_N;
  out.debounced(overload, kOverloadDebounceTicks, state.overload_ticks[i], FaultNumber::kCableOverload, index);
}

}  // namespace liana::cable
