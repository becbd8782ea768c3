// Operator filter: a tip pose that follows its target with bounded velocity, acceleration and jerk, without the tremor
// of the hand that led it.
//
// The target passes the tremor stage (tremor_notch.hpp). Then nested saturation, position and attitude alike, towards
// where the target will be lead seconds on if it keeps its velocity u (e = target + lead u - state, |u| <= v_max):
//   v* = sat(k1 e, v_max),  a* = sat(k2 (v* - v), a_max),  j = sat(k3 (a* - a), j_max)
// with k1 = a_max / v_max (FilterBounds::pull_1_s), k2 = j_max / a_max, k3 = 4 k2, so that each stage can brake what
// the stage before asks. Below the limits it is a linear third-order filter without overshoot; its lag behind a target
// at constant velocity is 1/k1 - lead (lag_s()): the inner stages follow a constant velocity without error. A target
// that stops dead is not overshot as long as there is room to brake: lag >= v_max / (2 a_max) + a_max / (4 j_max)
// (min_lag_s()).
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/math/pose.hpp"
#include "firmware_like/math/slow_directions.hpp"
#include "firmware_like/operator_input/tremor_notch.hpp"

namespace liana {

// Bounds of one channel; metres or radians.
struct FilterBounds {
  double speed = 0.0;     // > 0
  double accel = 0.0;     // > 0
  double jerk = 0.0;      // > 0
  double pull_1_s = 0.0;  // k1; 0: accel / speed
  double lead_s = 0.0;    // >= 0
};

// Three coordinates following a target; vectors are limited by length, so direction is kept.
struct ChannelState {
  Vec3 velocity{};
  Vec3 acceleration{};
};

struct TipFilterState {
  Pose pose{};             // filtered target for the IK
  ChannelState linear{};   // m/s, m/s2 in the base frame
  ChannelState angular{};  // rad/s, rad/s2 in the base frame
  bool speed_limited = false;
  bool accel_limited = false;
  TremorState tremor{};  // of the target; a filter that brakes forgets it
};

struct TipFilterConfig {
  FilterBounds linear{};
  FilterBounds angular{};
  double tick_s = 0.0;
  // Of the base frame, in which the tip takes less of every bound; null: none.
  const SlowDirections *slow_ways = nullptr, *slow_turns = nullptr;
};

// What acted in one step of a channel.
struct ChannelLimits {
  bool speed = false;
  bool accel = false;
};

// One tick of one channel: velocity (and acceleration) change so as to bring `error` = target - state to zero; the
// caller integrates velocity. From above a speed limit that was lowered it comes down to it within accel and jerk; a
// tip that speeds up then passes it by accel^2 / (2 jerk) for a moment.
ChannelLimits follow_channel(const FilterBounds& bounds, double tick_s, const Vec3& error,
                             ChannelState& state) noexcept;

// One tick of one channel to rest along its path: at full acceleration, with the jerk limit at either end, in a time
// that ends: speed / accel + accel / jerk [s] at most from a constant velocity. The last step is as small as half of
// what the acceleration allows in a tick. True while the acceleration limit acts.
bool brake_channel(const FilterBounds& bounds, double tick_s, ChannelState& state) noexcept;

// Lag [s] behind a target that moves with constant velocity below the limits, without the tremor stage's kTremorLag_s.
double lag_s(const FilterBounds& bounds) noexcept;

// The shortest lag [s] with which a target that stops dead is not overshot by more than 5 ms of the speed limit.
double min_lag_s(const FilterBounds& bounds) noexcept;

// The same bounds with a lag of `lag_s`, and a speed limit that may be lowered to `speed` without changing it: pull and
// lead are those of the bounds as they are. A lag of 0 is left to the speed limit in force, accel and nothing else.
FilterBounds with_lag(const FilterBounds& bounds, double lag_s, double speed) noexcept;

// One tick towards `target`. A target that is not a valid pose is ignored: the filter brakes instead.
void filter_tip(const TipFilterConfig& config, const Pose& target, TipFilterState& state) noexcept;

// How far the filter may lead an arm that does not come after it: freely up to `free`, and not beyond `most`.
struct Leash {
  double free_m = 0.0, most_m = 0.0;
  double free_rad = 0.0, max_rad = 0.0;
};

// Takes back, of the tick just made, what leads further away from an arm that is `lead` behind already (position [m],
// rotation vector [rad]; filter less arm). What leads back, or beside, stays: a blocked arm can be led away.
void hold_back(const Leash& leash, const std::array<double, 6>& lead, double tick_s, TipFilterState& state) noexcept;

// One tick of braking along the path: velocity to zero within the same bounds (brake_channel).
void brake_tip(const TipFilterConfig& config, TipFilterState& state) noexcept;

// True when the filter stands still to within 1e-6 m/s and 1e-6 rad/s.
bool at_rest(const TipFilterState& state) noexcept;

}  // namespace liana
