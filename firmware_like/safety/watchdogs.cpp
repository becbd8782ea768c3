#include "firmware_like/safety/watchdogs.hpp"

#include <limits>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana {
namespace {

// One pass over the inputs of a tick: latches, and counts what is wrong now.
class Watch {
 public:
  Watch(std::uint64_t tick, FaultList& faults) noexcept : tick_(tick), faults_(faults) {}

  // Reports a condition of drive or bus `index` that is wrong now.
  void wrong(FaultNumber number, std::int32_t index, std::uint16_t detail) noexcept {
    latch(faults_, {number, narrow<std::int16_t>(index), detail, tick_});
    ++active_;
  }

  // The same for a condition that must have been wrong for `debounce` ticks in a row.
  void debounced(bool is_wrong, std::uint16_t debounce, std::uint16_t& ticks, FaultNumber number, std::int32_t index) noexcept {
    if (!is_wrong) {
      ticks = 0;
      return;
    }
    if (ticks < debounce) ++ticks;
    if (ticks >= debounce) wrong(number, index, 0);
  }

  std::int32_t active() const noexcept { return active_; }

 private:
  std::uint64_t tick_;
  FaultList& faults_;
  std::int32_t active_ = 0;
};

void watch_buses(std::uint32_t lost_bus_mask, Watch& out) noexcept {
  if (lost_bus_mask == 0) return;
  for (std::int32_t bus = 0; bus < 32; ++bus) {
    if ((lost_bus_mask >> static_cast<std::uint32_t>(bus)) & 1U) out.wrong(FaultNumber::kBusLost, bus, 0);
  }
}

// Heartbeat, NMT state and age of feedback, for a drive that has been alive.
void watch_link(const WatchdogLimits& limits, const DriveFeedback& drive, std::int32_t i, WatchdogState& state, Watch& out) noexcept {
  const std::uint32_t bit = 1U << static_cast<std::uint32_t>(i);
  const bool silent = drive.feedback_age_ticks > kFeedbackAgeTicks;
  const bool missing = drive.heartbeat_age_ticks > limits.heartbeat_age_ticks;
  if (!silent && !missing && drive.operational != 0) state.seen_mask |= bit;
  if ((state.seen_mask & bit) == 0) return;
  if (silent) out.wrong(FaultNumber::kDriveSilent, i, drive.feedback_age_ticks);
  if (missing) out.wrong(FaultNumber::kDriveMissing, i, drive.heartbeat_age_ticks);
  if (drive.operational == 0) out.wrong(FaultNumber::kDriveNotOperational, i, 0);
}

// Fault and operation state. The emergency frame may come a tick before or after the statusword, so the code is kept.
void watch_state(WatchScope scope, const DriveFeedback& drive, std::int32_t i, WatchdogState& state, Watch& out) noexcept {
  std::uint16_t& code = state.emergency_code[as_index(i)];
  if (drive.emergency_code != 0) code = drive.emergency_code;
  const DriveState now = decode(drive.statusword);
  if (now == DriveState::kFault || now == DriveState::kFaultReactionActive) {
    out.wrong(FaultNumber::kDriveFault, i, code);
  } else {
    if (scope.powered && now != DriveState::kOperationEnabled) out.wrong(FaultNumber::kDriveLeftOperation, i, drive.statusword);
    if (drive.emergency_code == 0) code = 0;
  }
}

void watch_cable(const WatchdogLimits& limits, WatchScope scope, double tension_N, double lowpass_N, std::int32_t drive,
                 WatchdogState& state, Watch& out) noexcept {
  const std::size_t i = as_index(drive);
  if (tension_N >= limits.slack_N && tension_N <= limits.alarm_N && tension_N <= limits.hard_limit_N) {
    state.slack_ticks[i] = state.alarm_ticks[i] = state.overload_ticks[i] = 0;
    return;
  }
  const bool slack = scope.tensioned && !(tension_N >= limits.slack_N);  // so written, NaN is slack
  out.debounced(slack, kSlackDebounceTicks, state.slack_ticks[i], FaultNumber::kCableSlack, drive);
  // A motor that is not where it was told to be may have let the cable go itself.
  const bool broken = state.slack_ticks[i] == kBreakDebounceTicks && lowpass_N > limits.firm_N && state.following_ticks[i] == 0;
  if (broken) out.wrong(FaultNumber::kCableBreak, drive, 0);
  out.debounced(scope.powered && tension_N > limits.alarm_N, kAlarmDebounceTicks, state.alarm_ticks[i], FaultNumber::kTensionAlarm, drive);
  out.debounced(scope.powered && tension_N > limits.hard_limit_N, kOverloadDebounceTicks, state.overload_ticks[i],
                FaultNumber::kCableOverload, drive);
}

bool lags(std::int64_t window_counts, std::int32_t target_counts, std::int32_t position_counts) noexcept {
  const std::int64_t lag = static_cast<std::int64_t>(target_counts) - position_counts;
  return lag > window_counts || lag < -window_counts;
}

}  // namespace

WatchdogLimits make_watchdog_limits(const RobotTable& table) noexcept {
  WatchdogLimits limits{};
  limits.drive_count = table.cable_count();
  limits.heartbeat_age_ticks = narrow<std::uint16_t>(to_counts(kHeartbeatTimeout_s / table.tick_s).value);
  const double delay_s = table.servo_time_constant_s + kFollowingDeadTicks * table.tick_s;
  const double window_m = kFollowingWindow_m + kFollowingSpeedMargin * table.limits.cable_speed_m_s * delay_s;
  for (std::int32_t i = 0; i < limits.drive_count; ++i) {
    limits.following_counts[as_index(i)] = to_counts(window_m / table.drive[as_index(i)].metres_per_count).value;
  }
  limits.slack_N = table.tension.floor_anywhere_N;
  limits.firm_N = kBreakShare * table.tension.floor_motor_N;
  limits.alarm_N = table.tension.alarm_N;
  limits.hard_limit_N = table.tension.hard_limit_N;
  return limits;
}

std::int32_t watch(const WatchdogLimits& limits, WatchScope scope, const Inputs& inputs, const std::array<DriveCommand, kMaxCables>& sent,
                   const CableVector& tension_motor_N, const CableVector& tension_lowpass_N, WatchdogState& state,
                   FaultList& faults) noexcept {
  Watch out(inputs.tick, faults);
  watch_buses(inputs.lost_bus_mask, out);
  if (scope.powered && inputs.lost_ticks > kToleratedLostTicks) {
    out.wrong(FaultNumber::kTicksLost, -1, narrow<std::uint16_t>(inputs.lost_ticks));
  }
  for (std::int32_t drive = 0; drive < limits.drive_count; ++drive) {
    const std::size_t i = as_index(drive);
    watch_link(limits, inputs.drive[i], drive, state, out);
    watch_state(scope, inputs.drive[i], drive, state, out);
    watch_cable(limits, scope, tension_motor_N[i], tension_lowpass_N[i], drive, state, out);
    const bool late = scope.powered && lags(limits.following_counts[i], sent[i].target_counts, inputs.drive[i].position_counts);
    out.debounced(late, kFollowingDebounceTicks, state.following_ticks[i], FaultNumber::kFollowingError, drive);
  }
  return out.active();
}

}  // namespace liana
