#include "host/model/inverse_kinematics/goal_ik.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::inverse_kinematics {
namespace {

using Index = std::size_t;

// xorshift64*: a fixed sequence of numbers in [-1, 1).
double next_random(std::uint64_t& state) noexcept {
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  const std::uint64_t bits = (state * 0x2545F4914F6CDD1DULL) >> 11;  // 53 bits
  return static_cast<double>(bits) / 4503599627370496.0 - 1.0;
}

bool is_held(const GoalIkProblem& problem, Index k) noexcept { return ((problem.held_mask >> k) & 1u) != 0; }

ThetaVector first_start(const RobotParams& table, const GoalIkProblem& problem) noexcept {
  ThetaVector theta{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = table.segment[k / 2].theta_limit_rad;
    theta[k] = is_held(problem, k) ? problem.held_rad[k] : clamp(problem.from_rad[k], -limit, limit);
  }
  return theta;
}

ThetaVector random_pose(const RobotParams& table, const GoalIkProblem& problem, std::uint64_t& random) noexcept {
  ThetaVector theta{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
    theta[k] =
        is_held(problem, k) ? problem.held_rad[k] : 0.9 * table.segment[k / 2].theta_limit_rad * next_random(random);
  return theta;
}

// The random pose whose tip is nearest to the goal.
ThetaVector next_start(const RobotParams& table, const GoalIkProblem& problem, std::uint64_t& random) noexcept {
  ThetaVector best{};
  double least = 1e300;
  for (std::int32_t i = 0; i < kGoalSeeds; ++i) {
    const ThetaVector theta = random_pose(table, problem, random);
    const double size2 = tip_error(problem.tip_in_base, tip_pose(table, arm_trig(table, theta))).size2();
    if (i > 0 && !(size2 < least)) continue;
    least = size2;
    best = theta;
  }
  return best;
}

bool is_node(const RobotParams& table, const NodeTarget& target) noexcept {
  return target.node >= 1 && target.node <= table.segment_count;
}

// How far each node alone could go from the first solution.
void find_reach(const RobotParams& table, const GoalIkProblem& problem, const IkGoal& goal, const ThetaVector& theta,
                GoalIkResult& result) noexcept {
  for (Index i = 0; i < kMaxNodeTargets; ++i) {
    const NodeTarget& target = problem.node[i];
    if (is_node(table, target)) result.node_reach[i] = node_reach(table, goal, theta, target.node, target.position_m);
  }
}

void report_pose(const RobotParams& table, const GoalIkProblem& problem, GoalIkResult& result) noexcept {
  const ArmKinematics arm = forward_kinematics(table, result.theta_rad);
  const TipError error = tip_error(problem.tip_in_base, arm.tip_in_base);
  result.converged = error.converged();
  result.position_error_m = error.position_m;
  result.attitude_error_rad = error.attitude_rad;
  for (Index i = 0; i < kMaxNodeTargets; ++i) {
    const NodeTarget& target = problem.node[i];
    if (!is_node(table, target)) continue;
    result.node_distance_m[i] =
        norm(subtract(target.position_m, arm.node_in_base[static_cast<Index>(target.node)].position_m));
    result.node_reach[i].least_m = smaller(result.node_reach[i].least_m, result.node_distance_m[i]);
  }
}

}  // namespace

GoalIkResult solve_goal(const RobotParams& table, const GoalIkProblem& problem) noexcept {
  const ShapeProblem shape{{problem.tip_in_base, problem.held_mask}, problem.node, problem.clear};
  const std::int32_t wanted = wants_shape(table, shape) ? kGoalShapeStarts : 1;
  GoalIkResult result;
  double min_error2 = 1e300, min_sum_m = 1e300;
  std::uint64_t random = 0x9E3779B97F4A7C15ULL;
  std::int32_t found = 0;
  for (std::int32_t attempt = 0; attempt < kGoalAttempts && found < wanted; ++attempt) {
    ThetaVector theta = attempt == 0 ? first_start(table, problem) : next_start(table, problem, random);
    const TipError error =
        approach_tip(table, shape.goal, kGoalIterations, kGoalMostIterations, theta, result.iterations);
    if (!error.converged()) {
      if (found == 0 && (attempt == 0 || error.size2() < min_error2))
        min_error2 = error.size2(), result.theta_rad = theta;
      continue;
    }
    if (++found == 1) find_reach(table, problem, shape.goal, theta, result);
    const double sum_m = wanted > 1 ? improve_shape(table, shape, theta, result.iterations) : 0.0;
    if (found == 1 || sum_m < min_sum_m) min_sum_m = sum_m, result.theta_rad = theta;
  }
  report_pose(table, problem, result);
  return result;
}

}  // namespace liana::inverse_kinematics
