// Where the tip of a cable arm is in none of its poses, without a search: what the limits of all its joints together
// exclude. The arm may be in less than they leave, never in more.
#pragma once

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::inverse_kinematics {

// What every pose within the limits keeps to.
struct TipBounds {
  double turn_rad = 0.0;   // of the tip from its attitude in the straight arm, at most
  double forward_m = 0.0;  // of the tip along the base's x axis, at least
  double nearest_m = 0.0;  // of the tip from the base, at least
};

TipBounds tip_bounds(const cable::RobotParams& table) noexcept;

}  // namespace liana::inverse_kinematics
