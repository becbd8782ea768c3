// Operator filter: a tip pose that follows its target with bounded velocity, acceleration and jerk.
//
// Nested saturation, position and attitude alike (e = target - state):
//   v* = sat(k1 e, v_max),  a* = sat(k2 (v* - v), a_max),  j = sat(k3 (a* - a), j_max)
// with k1 = a_max / v_max, k2 = j_max / a_max, k3 = 4 k2, so that each stage can brake what the stage before asks.
// Below the limits it is a linear third-order filter without overshoot; its lag behind a target at constant velocity is
// 1/k1 (lag_s()): the inner stages follow a constant velocity without error.
#pragma once

#include <cstdint>

#include "firmware_like/math/pose.hpp"

namespace liana {

// Bounds of one channel; metres or radians.
struct FilterBounds {
  double speed = 0.0;  // > 0
  double accel = 0.0;  // > 0
  double jerk = 0.0;   // > 0
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
};

struct TipFilterConfig {
  FilterBounds linear{};
  FilterBounds angular{};
  double tick_s = 0.0;
};

// What acted in one step of a channel.
struct ChannelLimits {
  bool speed = false;
  bool accel = false;
};

// One tick of one channel: velocity (and acceleration) change so as to bring `error` = target - state to zero; the
// caller integrates velocity.
ChannelLimits follow_channel(const FilterBounds& bounds, double tick_s, const Vec3& error,
                             ChannelState& state) noexcept;

// One tick of one channel to rest along its path: at full acceleration, with the jerk limit at either end, in a time
// that ends: speed / accel + accel / jerk [s] at most from a constant velocity. The last step is as small as half of
// what the acceleration allows in a tick. True while the acceleration limit acts.
bool brake_channel(const FilterBounds& bounds, double tick_s, ChannelState& state) noexcept;

// Lag [s] behind a target that moves with constant velocity below the limits.
double lag_s(const FilterBounds& bounds) noexcept;

// One tick towards `target`. A target that is not a valid pose is ignored: the filter brakes instead.
void filter_tip(const TipFilterConfig& config, const Pose& target, TipFilterState& state) noexcept;

// One tick of braking along the path: velocity to zero within the same bounds (brake_channel).
void brake_tip(const TipFilterConfig& config, TipFilterState& state) noexcept;

// True when the filter stands still to within 1e-6 m/s and 1e-6 rad/s.
bool at_rest(const TipFilterState& state) noexcept;

}  // namespace liana
