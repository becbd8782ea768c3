// Watchdogs: what the drives, the buses and the clock report, turned into numbered faults.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/controller_io.hpp"

namespace liana {

constexpr std::uint16_t kFeedbackAgeTicks = 2;     // a TPDO may be missing for two ticks
constexpr std::uint32_t kToleratedLostTicks = 2;   // drives quick-stop by themselves after three periods without RPDO
constexpr double kHeartbeatTimeout_s = 0.3;        // drives produce one every 0.1 s
constexpr std::uint16_t kSlackDebounceTicks = 25;  // far longer than a stick-slip dip, far shorter than a cable leaving its drum
constexpr std::uint16_t kBreakDebounceTicks = 3;   // one wrong torque sample is not a break
constexpr double kBreakShare = 0.5;  // of the tension floor: a cable that was so tight a moment ago does not come loose by itself
constexpr std::uint16_t kAlarmDebounceTicks = 25;
constexpr std::uint16_t kOverloadDebounceTicks = 3;  // one wrong torque sample is not an overload
constexpr std::uint16_t kFollowingDebounceTicks = 5;
constexpr double kFollowingWindow_m = 0.2e-3;   // at rest: drive resolution, loop error and elasticity of the drum
constexpr double kFollowingSpeedMargin = 1.25;  // over the cable speed limit, as the gate lets pass
constexpr double kFollowingDeadTicks = 4.0;     // target to sample two ticks, feedback up to two ticks old

// Limits derived once from the robot table.
struct WatchdogLimits {
  std::int32_t drive_count = 0;
  std::uint16_t heartbeat_age_ticks = 0;
  std::array<std::int64_t, kMaxCables> following_counts{};  // largest |sent target - position|
  double slack_N = 0.0;
  double firm_N = 0.0;  // of the low-passed tension: who falls from here to slack at once is broken
  double alarm_N = 0.0;
  double hard_limit_N = 0.0;
};

// Limits of a checked table.
WatchdogLimits make_watchdog_limits(const RobotTable& table) noexcept;

// Ticks in a row in which a condition was seen, and what was learned about each drive.
struct WatchdogState {
  std::uint32_t seen_mask = 0;                             // bit i: drive i was alive and operational since start
  std::array<std::uint16_t, kMaxCables> emergency_code{};  // last one of the present fault
  std::array<std::uint16_t, kMaxCables> following_ticks{};
  std::array<std::uint16_t, kMaxCables> slack_ticks{};
  std::array<std::uint16_t, kMaxCables> alarm_ticks{};
  std::array<std::uint16_t, kMaxCables> overload_ticks{};
};

// What has to hold at this moment; the supervisor says (watch_scope).
struct WatchScope {
  bool powered = false;    // every drive must be in Operation enabled and follow its target, with tension under the limits
  bool tensioned = false;  // besides, no cable may be slack
};

// Latches what went wrong in this tick. `sent` is what the previous tick sent, `tension_motor_N` comes from the drive torques of this tick
// (a value that is not finite counts as slack), `tension_lowpass_N` is the same over kTensionFilter_s. Returns how many conditions are
// wrong now, latched before or not: 0 means that the causes are gone. A drive that was never alive is not a fault (it only blocks
// enabling).
std::int32_t watch(const WatchdogLimits& limits, WatchScope scope, const Inputs& inputs, const std::array<DriveCommand, kMaxCables>& sent,
                   const CableVector& tension_motor_N, const CableVector& tension_lowpass_N, WatchdogState& state,
                   FaultList& faults) noexcept;

}  // namespace liana
