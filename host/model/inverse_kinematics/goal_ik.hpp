// Goal IK: joint angles for a tip pose from anywhere, with restarts in a fixed order. For goals and plans, outside the
// tick.
//
// An attempt iterates servo_ik, whose damping is proportional to the squared error (performance study: that and
// restarts are what helps). Attempt 0 starts at `from`; each later one at the best of kGoalSeeds pseudo-random poses of
// a fixed sequence: same input, same result. When something is wanted of the shape, it is improved from
// kGoalShapeStarts solutions and the best is taken. Figures: docs/explanation/shape.md.
#pragma once

#include <array>
#include <cstdint>

#include "host/model/inverse_kinematics/improve_shape.hpp"

namespace liana::inverse_kinematics {

constexpr std::int32_t kGoalAttempts = 100;
constexpr std::int32_t kGoalIterations = 10;      // per attempt, more only while the error halves with each
constexpr std::int32_t kGoalMostIterations = 30;  // per attempt
constexpr std::int32_t kGoalSeeds = 32;           // poses that an attempt chooses from
constexpr std::int32_t kGoalShapeStarts = 24;     // solutions whose shape is improved

struct GoalIkProblem {
  Pose tip_in_base{};
  ThetaVector from_rad{};       // where the arm is; the first attempt starts here
  std::uint32_t held_mask = 0;  // bit i: theta i stays at held_rad
  ThetaVector held_rad{};
  NodeTargets node{};
  KeepClearTargets clear{};
};

struct GoalIkResult {
  ThetaVector theta_rad{};
  bool converged = false;
  std::int32_t iterations = 0;  // over all attempts, those of the shape included
  double position_error_m = 0.0;
  double attitude_error_rad = 0.0;
  std::array<double, kMaxNodeTargets> node_distance_m{};  // in the order of the problem's targets
  std::array<NodeReach, kMaxNodeTargets>
      node_reach{};  // of each alone, from the first solution found; zero when not converged
};

// Solves; when no attempt converges, the result holds the best one. Angles respect the limits, held ones are exact.
// At most kGoalAttempts * kGoalMostIterations iterations for the tip.
GoalIkResult solve_goal(const RobotParams& table, const GoalIkProblem& problem) noexcept;

}  // namespace liana::inverse_kinematics
