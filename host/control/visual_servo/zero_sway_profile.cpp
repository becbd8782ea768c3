#include "host/control/visual_servo/zero_sway_profile.hpp"

#include <algorithm>

namespace liana::visual_servo {

ZeroSwayProfile::ZeroSwayProfile(const Pose& from, const Pose& to, const ApproachLimits& limits,
                                 const motion::Swings& swings)
    : from_(from), to_(to), turn_rad_(rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)))) {
  const Vec3 way_m = subtract(to.position_m, from.position_m);
  Vec3 across_m = way_m;
  across_m[limits.axis] = 0.0;
  const double turn_rad = norm(turn_rad_);
  motion::MoveNeeds needs;
  needs.speed_s = std::max({norm(way_m) / limits.speed_m_s, norm(across_m) / limits.lateral_speed_m_s,
                            turn_rad / limits.rate_rad_s}) /
                  motion::kMoveShare;
  needs.accel_s2 =
      std::max(norm(way_m) / limits.accel_m_s2, turn_rad / limits.angular_accel_rad_s2) / motion::kMoveShare;
  law_ = motion::TrajectoryTiming(needs, swings);
}

Pose ZeroSwayProfile::at(double time_s) const {
  const double left = 1.0 - law_.share_at(time_s);
  return {add(to_.position_m, scale(subtract(from_.position_m, to_.position_m), left)),
          normalize(multiply(quaternion_of(scale(turn_rad_, -left)), to_.quaternion))};
}

}  // namespace liana::visual_servo
