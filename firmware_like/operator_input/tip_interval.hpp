// The tip target over a command interval, and a filter that takes only a share of a tick's motion: the same for every
// arm.
#pragma once

#include <cstdint>

#include "firmware_like/operator_input/tip_filter.hpp"

namespace liana {

// Share (0..1) of a command interval of `ticks` that is over after `tick`.
inline double interval_share(std::int32_t tick, std::int32_t ticks) noexcept {
  return tick >= ticks ? 1.0 : static_cast<double>(tick) / ticks;
}

// Between two poses; `turn_rad` is the rotation from one to the other, base frame.
inline Pose interpolated_pose(const Pose& from, const Pose& to, const Vec3& turn_rad, double share) noexcept {
  return {add(from.position_m, scale(subtract(to.position_m, from.position_m), share)),
          normalize(multiply(quaternion_of(scale(turn_rad, share)), from.quaternion))};
}

// Between two poses that are one tick apart.
inline Pose pose_between(const Pose& a, const Pose& b, double share) noexcept {
  Quat q{};
  for (std::size_t i = 0; i < 4; ++i) q[i] = a.quaternion[i] + share * (b.quaternion[i] - a.quaternion[i]);
  return {add(a.position_m, scale(subtract(b.position_m, a.position_m), share)), normalize(q)};
}

inline void slow_channel(double share, ChannelState& channel) noexcept {
  channel.velocity = scale(channel.velocity, share);
  channel.acceleration = scale(channel.acceleration, share);
}

// Takes back all but a share of the tick in which the filter went on from `before`: it slows down on its path.
inline void slow_filter(const Pose& before, double share, TipFilterState& filter) noexcept {
  filter.pose = pose_between(before, filter.pose, share);
  slow_channel(share, filter.linear);
  slow_channel(share, filter.angular);
}

// Takes back all but a share of how the tick changed the velocities of `before`.
inline void go_between(const TipFilterState& before, double share, double tick_s, TipFilterState& filter) noexcept {
  const auto between = [share](const ChannelState& from, ChannelState& to) {
    to.velocity = add(from.velocity, scale(subtract(to.velocity, from.velocity), share));
    to.acceleration = scale(to.acceleration, share);
  };
  between(before.linear, filter.linear);
  between(before.angular, filter.angular);
  filter.pose.position_m = add(before.pose.position_m, scale(filter.linear.velocity, tick_s));
  filter.pose.quaternion =
      normalize(multiply(quaternion_of(scale(filter.angular.velocity, tick_s)), before.pose.quaternion));
}

}  // namespace liana
