#include "host/control/arbiter/tip_line.hpp"

namespace liana::arbiter {

TipLine::TipLine(const TipBounds& bounds, const Pose& from, const Pose& to, double speed_m_s,
                 const motion::Swings& swings)
    : from_(from), to_(to) {
  FilterBounds linear = bounds.linear;
  linear.speed = speed_m_s;
  turn_rad_ = rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
  motion::MoveNeeds needs;
  needs.add(norm(subtract(to.position_m, from.position_m)), motion::share_of(linear));
  needs.add(norm(turn_rad_), motion::share_of(bounds.angular));
  law_ = motion::TrajectoryTiming(needs, swings);
}

Pose TipLine::at(double time_s) const {
  if (time_s >= law_.duration_s()) return to_;
  const double s = law_.share_at(time_s);
  return {add(from_.position_m, scale(subtract(to_.position_m, from_.position_m), s)),
          normalize(multiply(quaternion_of(scale(turn_rad_, s)), from_.quaternion))};
}

}  // namespace liana::arbiter
