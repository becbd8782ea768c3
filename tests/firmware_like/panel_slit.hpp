// The slit of the scene panel_slit, for tests.
#pragma once

#include "host/model/inverse_kinematics/dof_split.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {

using namespace inverse_kinematics;

// Its plane is that of the press rod's pose, its room the half gap of 50 mm less 30 mm of arm.
inline SlitMouth panel_slit() {
  const RobotParams robot = zhu2022::table();
  const Pose rod = forward_kinematics(robot, zhu2022::radians(zhu2022::kPressRod_deg)).tip_in_base;
  const Vec3 n = rotate(rod.quaternion, {0.0, 1.0, 0.0});
  const Vec3 along = subtract({1.0, 0.0, 0.0}, scale(n, n[0]));
  const Vec3 u = scale(along, 1.0 / norm(along));
  const Vec3 rod_u =
      rotate(conjugate(rod.quaternion), u);  // the rod's frame turned about its y (which is n) until its x is u
  const double angle = arc_tangent(-rod_u[2], rod_u[0]);
  const Quat frame = multiply(rod.quaternion, quaternion_of({0.0, angle, 0.0}));
  return {{add(scale(u, 1.75), scale(n, dot(n, rod.position_m))), frame}, 1.95, 0.02, 1.97};
}

}  // namespace liana::cable
