// Goal IK: joint angles for a tip pose from anywhere, with restarts in a fixed order. For goals and plans, outside the tick.
//
// Each attempt iterates ik_step with error-proportional damping mu = e.e + 1e-9 (performance study, section 3: that and restarts are what
// helps). Attempt 0 starts at `from`, attempt 1 at the middle, the others at pseudo-random poses of a fixed sequence: same input, same
// result.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/motion/servo_ik.hpp"
#include "firmware_like/motion/shape.hpp"

namespace liana {

constexpr std::int32_t kGoalAttempts = 100;
constexpr std::int32_t kGoalIterations = 25;   // per attempt
constexpr std::int32_t kGoalShapeSteps = 200;  // towards node targets, after the tip has been reached
constexpr double kGoalTolerance = 1e-7;        // m and rad; half a decade inside what is promised (1e-6)

struct GoalIkProblem {
  Pose tip_in_base{};
  ThetaVector from_rad{};       // where the arm is; the first attempt starts here
  std::uint32_t held_mask = 0;  // bit i: theta i stays at held_rad
  ThetaVector held_rad{};
  NodeTargets node{};
};

struct GoalIkResult {
  ThetaVector theta_rad{};
  bool converged = false;
  std::int32_t iterations = 0;  // over all attempts
  double position_error_m = 0.0;
  double attitude_error_rad = 0.0;
  std::array<double, kMaxNodeTargets> node_distance_m{};  // in the order of the problem's targets
};

// Solves; when no attempt converges, the result holds the best one. Angles respect the limits, held ones are exact.
GoalIkResult solve_goal(const RobotTable& table, const GoalIkProblem& problem) noexcept;

}  // namespace liana
