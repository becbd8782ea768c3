// What the core's tests ask of an arm in a pose: its cables, where they slip, and how far it is from a goal.
#pragma once

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/tension.hpp"
#include "firmware_like/math/ik_outcome.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {

inline CableGeometry geometry_at(const RobotParams& robot, const ThetaVector& theta) {
  return cable_geometry(robot, cable_layout(robot), arm_trig(robot, theta));
}

inline SlipState random_slip(zhu2022::Random& random) {
  SlipState slip;
  for (auto& row : slip.sigma) {
    for (double& sigma : row) sigma = random.uniform(-1.0, 1.0);
  }
  return slip;
}

inline double pose_difference(const Pose& a, const Pose& b) { return zhu2022::length(pose_error(a, b)); }

inline double error_of(const RobotParams& robot, const Pose& goal, const ThetaVector& theta) {
  return pose_difference(goal, forward_kinematics(robot, theta).tip_in_base);
}

}  // namespace liana::cable
