// Watchdogs of every robot: what the drives, the buses and the clock report, turned into numbered faults.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/safety/cycle_inputs.hpp"
#include "firmware_like/safety/faults.hpp"
#include "firmware_like/safety/patience.hpp"

namespace liana {

constexpr std::uint16_t kFeedbackAgeTicks = 2;    // a TPDO may be missing for two ticks
constexpr std::uint32_t kToleratedLostTicks = 2;  // drives quick-stop by themselves after three periods without RPDO
constexpr double kHeartbeatTimeout_s = 0.3;       // drives produce one every 0.1 s
constexpr std::uint16_t kFollowingDebounceTicks = 5;
constexpr std::uint16_t kTwiceTicks =
    8;  // in a row with two voices under one drive's identifiers; the host counts them
constexpr std::uint32_t kModeRoundTicks = 8;  // the host asks every drive with power for its mode once in so many
constexpr double kFollowingDeadTicks = 4.0;   // target to sample two ticks, feedback up to two ticks old

// How much faster than the arm's own limit a target may move, for the gate and for the following error: room for what
// an arm adds to its planned motion (elongation of cables, damping).
constexpr double kTargetSpeedMargin = 1.25;

constexpr double kJumpShare = 3.0;  // of an axis' rate: between two readings none moves faster

// Time [s] at full rate that an axis may move from one tick to the next; more, and its encoder has jumped. A message
// may be missing for kFeedbackAgeTicks without a fault, and the axis moves on meanwhile. The twin's drives are at their
// targets at once, from as far behind them as a position servo lags.
constexpr double jump_s(double tick_s, double servo_time_constant_s) noexcept {
  return kJumpShare * tick_s * (1.0 + kFeedbackAgeTicks) + kTargetSpeedMargin * servo_time_constant_s;
}

// Limits derived once from the robot table, in drive units.
struct LinkLimits {
  std::int32_t drive_count = 0;
  std::uint16_t heartbeat_age_ticks = 0;
  Patience patience{};
  std::array<std::int64_t, kMaxDrives> following_counts{};  // largest |sent target - position|
};

// Ticks without a heartbeat after which a drive is missing.
constexpr std::uint16_t heartbeat_age_ticks(double tick_s) noexcept {
  return narrow<std::uint16_t>(to_counts(kHeartbeatTimeout_s / tick_s).value);
}

// Ticks in a row in which a condition was seen, and what was learned about each drive.
struct DriveLinkMonitorState {
  std::uint32_t seen_mask = 0;     // bit i: drive i was alive and operational since start, or should have been
  std::uint16_t unseen_ticks = 0;  // since start, up to heartbeat_age_ticks: then every drive is watched
  std::array<std::uint16_t, kMaxDrives> emergency_code{};  // last one of the present fault
  std::array<std::uint16_t, kMaxDrives> following_ticks{};
};

// What has to hold at this moment; the supervisor says (watch_scope).
struct WatchScope {
  bool powered = false;   // every drive must be in Operation enabled and follow its target
  bool prepared = false;  // besides, the arm is ready for motion (a cable arm: no cable may be slack)
};

// One pass over the inputs of a tick: latches, and counts what is wrong now.
class Watch {
 public:
  Watch(std::uint64_t tick, FaultList& faults) noexcept : tick_(tick), faults_(faults) {}

  // Reports a condition of drive or bus `index` that is wrong now.
  void wrong(FaultNumber number, std::int32_t index, std::uint16_t detail) noexcept;
  // The same for a condition that must have been wrong for `debounce` ticks in a row.
  void debounced(bool is_wrong, std::uint16_t debounce, std::uint16_t& ticks, FaultNumber number,
                 std::int32_t index) noexcept;
  // How many conditions are wrong now, latched before or not: 0 means that the causes are gone.
  std::int32_t active() const noexcept { return active_; }

 private:
  std::uint64_t tick_;
  FaultList& faults_;
  std::int32_t active_ = 0;
};

// Lost buses, deadlines, and drives under whose identifiers somebody else speaks.
void watch_cycle(WatchScope scope, const CycleInputs& inputs, Watch& out) noexcept;

constexpr std::uint32_t all_drives(std::int32_t drive_count) noexcept {
  return drive_count >= kMaxDrives ? ~0U : (1U << static_cast<std::uint32_t>(drive_count)) - 1U;
}

// Drives are booted before the first tick: one that is not heard within the time of a heartbeat is watched all the
// same.
inline void watch_from_start(const LinkLimits& limits, DriveLinkMonitorState& state) noexcept {
  if (state.unseen_ticks == limits.heartbeat_age_ticks) return;
  if (++state.unseen_ticks == limits.heartbeat_age_ticks) state.seen_mask = all_drives(limits.drive_count);
}

// Heartbeat, NMT state, age of feedback, fault and operation state of one drive that has been alive, or should have.
void watch_doubtful_drive(const LinkLimits& limits, WatchScope scope, const DriveFeedback& drive, std::int32_t index,
                          DriveLinkMonitorState& state, Watch& out) noexcept;
inline void watch_drive(const LinkLimits& limits, WatchScope scope, const DriveFeedback& drive, std::int32_t index,
                        DriveLinkMonitorState& state, Watch& out) noexcept {
  if (drive.feedback_age_ticks <= kFeedbackAgeTicks && drive.heartbeat_age_ticks <= limits.heartbeat_age_ticks &&
      drive.operational == 1 && drive.emergency_code == 0 &&
      decode(drive.statusword) == DriveState::kOperationEnabled) {  // in which nothing can be wrong
    state.seen_mask |= 1U << static_cast<std::uint32_t>(index);
    state.emergency_code[as_index(index)] = 0;
  } else {
    watch_doubtful_drive(limits, scope, drive, index, state, out);
  }
}

// Whether one drive follows what was `sent` to it in the last tick.
inline void watch_following(const LinkLimits& limits, WatchScope scope, const DriveFeedback& drive,
                            const DriveCommand& sent, std::int32_t index, DriveLinkMonitorState& state,
                            Watch& out) noexcept {
  const std::size_t i = as_index(index);
  const std::int64_t lag_counts = static_cast<std::int64_t>(sent.target_counts) - drive.position_counts;
  const bool lags = lag_counts > limits.following_counts[i] || lag_counts < -limits.following_counts[i];
  if (scope.powered && lags) {
    out.debounced(true, kFollowingDebounceTicks, state.following_ticks[i], FaultNumber::kFollowingError, index);
  } else {
    state.following_ticks[i] = 0;
  }
}

}  // namespace liana
