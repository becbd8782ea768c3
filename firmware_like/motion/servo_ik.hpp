// Servo IK: joint angles that follow a moving tip pose, a constant number of iterations per tick (mission figures A2, A5, A6).
//
// Damped least squares on the free thetas: dtheta = J^T (J J^T + mu I)^-1 e, mu = kDamping + e.e. Held thetas are removed from the
// iteration and moved only by their own profile. A free theta that would pass its limit is set onto it and removed, and the rest is solved
// again. What the tip leaves free is moved by motion/shape.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/arm/kinematics.hpp"
#include "firmware_like/telecommand.hpp"

namespace liana {

constexpr std::int32_t kServoIterations = 2;  // per tick, always
constexpr std::int32_t kLimitPasses = 3;      // re-solves per iteration, at most
constexpr double kDamping = 1e-6;             // m2/rad2; singular directions slow down below |sigma| = 1e-3

struct IkGoal {
  Pose tip_in_base{};
  std::uint32_t held_mask = 0;  // bit i: theta i is not free
};

struct IkReport {
  double position_error_m = 0.0;
  double attitude_error_rad = 0.0;
  bool at_limit = false;  // a theta stands on its limit
  bool singular = false;  // the damping, not the target, decided the step
};

// Tip error (position, rotation vector) of `tip` against `goal`, base frame.
std::array<double, 6> pose_error(const Pose& goal, const Pose& tip) noexcept;

// One damped step of the free thetas towards the goal; limits respected exactly. Returns the tip error before the step.
IkReport ik_step(const RobotTable& table, const IkGoal& goal, double damping, ThetaVector& theta_rad) noexcept;

}  // namespace liana
