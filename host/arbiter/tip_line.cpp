#include "host/arbiter/tip_line.hpp"

#include <algorithm>

#include "host/arbiter/time_law.hpp"

namespace liana::arbiter {

TipLine::TipLine(const TipBounds& bounds, const Pose& from, const Pose& to, double speed_m_s) : from_(from), to_(to) {
  FilterBounds linear = bounds.linear;
  linear.speed = speed_m_s;
  turn_rad_ = rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
  duration_s_ = std::max(time_within(norm(subtract(to.position_m, from.position_m)), share_of(linear)),
                         time_within(norm(turn_rad_), share_of(bounds.angular)));
}

Pose TipLine::at(double time_s) const {
  if (time_s >= duration_s_) return to_;
  const double s = minimum_jerk(time_s / duration_s_);
  return {add(from_.position_m, scale(subtract(to_.position_m, from_.position_m), s)),
          normalize(multiply(quaternion_of(scale(turn_rad_, s)), from_.quaternion))};
}

}  // namespace liana::arbiter
