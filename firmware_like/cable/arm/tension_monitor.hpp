// Watchdogs of measured cable tension: slack, broken and overloaded cables.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"

namespace liana::cable {

constexpr std::uint16_t kSlackDebounceTicks =
    25;  // far longer than a stick-slip dip, far shorter than a cable leaving its drum
constexpr std::uint16_t kBreakDebounceTicks = 3;  // one wrong torque sample is not a break
constexpr double kBreakShare =
    0.5;  // of the tension floor: a cable that was so tight a moment ago does not come loose by itself
constexpr std::uint16_t kAlarmDebounceTicks = 25;
constexpr std::uint16_t kOverloadDebounceTicks = 3;  // one wrong torque sample is not an overload

// Limits derived once from the robot table.
struct TensionWatchLimits {
  double slack_N = 0.0;
  double firm_N = 0.0;  // of the low-passed tension: who falls from here to slack at once is broken
  double alarm_N = 0.0;
  double hard_limit_N = 0.0;
};

// Limits of a checked table.
TensionWatchLimits make_tension_watch_limits(const RobotParams& table) noexcept;

// Ticks in a row in which a condition was seen.
struct TensionMonitorState {
  std::array<std::uint16_t, kMaxCables> slack_ticks{};  // of a drive of a base: with a force that nothing explains
  std::array<std::uint16_t, kMaxCables> alarm_ticks{};
  std::array<std::uint16_t, kMaxCables> overload_ticks{};
};

// What is known about one cable in this tick.
struct TensionReading {
  double tension_N = 0.0;  // from the drive's torque; a value that is not finite counts as slack
  double lowpass_N = 0.0;  // the same over kTensionFilter_s
  bool follows = true;     // its motor is where it was told to be
};

// A slack cable that was firm a moment ago, with a motor that is where it was told to be: else it may have let the
// cable go itself. A cable that is gone pulls nothing; a reading far below that is a wrong one.
inline bool is_missed(const TensionWatchLimits& limits, const TensionReading& now) noexcept {
  return now.lowpass_N > limits.firm_N && now.follows && !(now.tension_N < -limits.firm_N);
}

// Latches what is wrong with cable `index` in this tick. Slack is looked for once the arm is prepared, overload while
// drives are powered.
void watch_doubtful_tension(const TensionWatchLimits& limits, WatchScope scope, const TensionReading& now,
                            std::int32_t index, TensionMonitorState& state, Watch& out) noexcept;
inline void watch_tension(const TensionWatchLimits& limits, WatchScope scope, const TensionReading& now,
                          std::int32_t index, TensionMonitorState& state, Watch& out) noexcept {
  if (now.tension_N >= limits.slack_N && now.tension_N <= limits.alarm_N) {  // which the hard limit is beyond
    const std::size_t i = as_index(index);
    state.slack_ticks[i] = state.alarm_ticks[i] = state.overload_ticks[i] = 0;
  } else {
    watch_doubtful_tension(limits, scope, now, index, state, out);
  }
}

}  // namespace liana::cable
