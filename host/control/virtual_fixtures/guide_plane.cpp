#include "host/control/virtual_fixtures/guide_plane.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/control/virtual_fixtures/placed.hpp"

namespace liana::virtual_fixtures {
namespace {

// The least turn from one unit vector to another; of opposite ones, which have no least, none.
Quat min_turn(const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  return normalize({1.0 + dot(from, to), axis[0], axis[1], axis[2]});
}

Quat level(const GuidePlane& plane, const Quat& tip) {
  const Vec3 normal = scale(rotate(plane.attitude, kY), plane.side);
  return normalize(multiply(min_turn(rotate(tip, kY), normal), tip));
}

// Of what is out of the range, the way to its nearer end.
double into_range(const GuidePlane& plane, double yaw) {
  if (yaw >= plane.yaw_low_rad && yaw <= plane.yaw_high_rad) return 0.0;
  const double to_low = std::remainder(plane.yaw_low_rad - yaw, 2.0 * kPi);
  const double to_high = std::remainder(plane.yaw_high_rad - yaw, 2.0 * kPi);
  return std::fabs(to_low) < std::fabs(to_high) ? to_low : to_high;
}

}  // namespace

double off_plane_m(const GuidePlane& plane, const Vec3& point_in_base) {
  const Vec3 normal = rotate(plane.frame_in_base.quaternion, kY);
  return dot(normal, subtract(point_in_base, plane.frame_in_base.position_m));
}

double yaw_rad(const GuidePlane& plane, const Quat& tip) {
  const Vec3 x = rotate(level(plane, tip), kX);
  return std::atan2(-dot(x, rotate(plane.attitude, kZ)), dot(x, rotate(plane.attitude, kX)));
}

Pose in_plane(const GuidePlane& plane, const Pose& goal) {
  const Vec3 normal = rotate(plane.frame_in_base.quaternion, kY);
  const Quat flat = level(plane, goal.quaternion);
  const double turn = into_range(plane, yaw_rad(plane, flat));
  const Quat yawed = multiply(quaternion_of(scale(rotate(plane.attitude, kY), turn)), flat);
  return {subtract(goal.position_m, scale(normal, off_plane_m(plane, goal.position_m))), normalize(yawed)};
}

}  // namespace liana::virtual_fixtures
