#include "firmware_like/motion/goal_ik.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana {
namespace {

using Index = std::size_t;

struct TipError {
  double position_m;
  double attitude_rad;
  double size2() const noexcept { return position_m * position_m + attitude_rad * attitude_rad; }
  bool converged() const noexcept { return position_m < kGoalTolerance && attitude_rad < kGoalTolerance; }
};

TipError tip_error(const RobotTable& table, const Pose& goal, const ThetaVector& theta) noexcept {
  const auto e = pose_error(goal, forward_kinematics(table, theta).tip_in_base);
  return {norm({e[0], e[1], e[2]}), norm({e[3], e[4], e[5]})};
}

// xorshift64*: a fixed sequence of numbers in [-1, 1).
double next_random(std::uint64_t& state) noexcept {
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  const std::uint64_t bits = (state * 0x2545F4914F6CDD1DULL) >> 11;  // 53 bits
  return static_cast<double>(bits) / 4503599627370496.0 - 1.0;
}

ThetaVector start_pose(const RobotTable& table, const GoalIkProblem& problem, std::int32_t attempt, std::uint64_t& random) noexcept {
  ThetaVector theta{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = table.segment[k / 2].theta_limit_rad;
    if (attempt == 0) theta[k] = clamp(problem.from_rad[k], -limit, limit);
    if (attempt > 1) theta[k] = 0.9 * limit * next_random(random);
    if (((problem.held_mask >> k) & 1u) != 0) theta[k] = problem.held_rad[k];
  }
  return theta;
}

// Iterates until converged or out of iterations; returns the error reached.
TipError iterate(const RobotTable& table, const IkGoal& goal, std::int32_t limit, ThetaVector& theta, std::int32_t& iterations) noexcept {
  TipError error = tip_error(table, goal.tip_in_base, theta);
  for (std::int32_t i = 0; i < limit && !error.converged(); ++i, ++iterations) {
    ik_step(table, goal, error.size2() + 1e-9, theta);
    error = tip_error(table, goal.tip_in_base, theta);
  }
  return error;
}

// Moves along the null space while the weighted node distance falls and the tip stays; halves the step when it does not.
void improve_shape(const RobotTable& table, const GoalIkProblem& problem, const IkGoal& goal, ThetaVector& theta,
                   std::int32_t& iterations) noexcept {
  double step = 1.0;  // share of the step that would bring the sum to zero
  for (std::int32_t i = 0; i < kGoalShapeSteps && step > 1e-6; ++i) {
    const ArmKinematics arm = forward_kinematics(table, theta);
    const NodeCost cost = node_cost(table, arm, problem.node);
    const ThetaVector descent = project(null_space(arm.tip_jacobian, table.theta_count(), problem.held_mask), cost.descent);
    double slope2 = 0.0;
    for (double d : descent) slope2 += d * d;
    if (!(cost.sum_m > 0.0) || !(slope2 > 1e-16)) return;
    ThetaVector candidate = theta;
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
      const double limit = table.segment[k / 2].theta_limit_rad;
      const double move = clamp(step * cost.sum_m / slope2 * descent[k], -0.05, 0.05);
      candidate[k] = clamp(theta[k] + move, -limit, limit);
    }
    const TipError error = iterate(table, goal, 8, candidate, iterations);
    const bool better = error.converged() && node_cost(table, forward_kinematics(table, candidate), problem.node).sum_m < cost.sum_m;
    if (better) theta = candidate;
    step = better ? smaller(1.0, 1.5 * step) : 0.5 * step;
  }
}

}  // namespace

GoalIkResult solve_goal(const RobotTable& table, const GoalIkProblem& problem) noexcept {
  const IkGoal goal{problem.tip_in_base, problem.held_mask};
  GoalIkResult result;
  TipError best{1e300, 1e300};
  std::uint64_t random = 0x9E3779B97F4A7C15ULL;
  for (std::int32_t attempt = 0; attempt < kGoalAttempts && !result.converged; ++attempt) {
    ThetaVector theta = start_pose(table, problem, attempt, random);
    const TipError error = iterate(table, goal, kGoalIterations, theta, result.iterations);
    result.converged = error.converged();
    if (result.converged || attempt == 0 || error.size2() < best.size2()) {
      best = error;
      result.theta_rad = theta;
    }
  }
  if (result.converged) improve_shape(table, problem, goal, result.theta_rad, result.iterations);
  best = tip_error(table, problem.tip_in_base, result.theta_rad);
  result.converged = best.converged();
  result.position_error_m = best.position_m;
  result.attitude_error_rad = best.attitude_rad;
  const ArmKinematics arm = forward_kinematics(table, result.theta_rad);
  for (Index i = 0; i < kMaxNodeTargets; ++i) {
    const NodeTarget& target = problem.node[i];
    if (target.node < 1 || target.node > table.segment_count) continue;
    result.node_distance_m[i] = norm(subtract(target.position_m, arm.node_in_base[static_cast<Index>(target.node)].position_m));
  }
  return result;
}

}  // namespace liana
