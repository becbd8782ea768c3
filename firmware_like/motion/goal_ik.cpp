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

TipError tip_error(const Pose& goal, const Pose& tip) noexcept {
  const auto e = pose_error(goal, tip);
  return {norm({e[0], e[1], e[2]}), norm({e[3], e[4], e[5]})};
}

TipError tip_error(const RobotTable& table, const Pose& goal, const ThetaVector& theta) noexcept {
  return tip_error(goal, tip_pose(table, arm_trig(table, theta)));
}

// xorshift64*: a fixed sequence of numbers in [-1, 1).
double next_random(std::uint64_t& state) noexcept {
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  const std::uint64_t bits = (state * 0x2545F4914F6CDD1DULL) >> 11;  // 53 bits
  return static_cast<double>(bits) / 4503599627370496.0 - 1.0;
}

bool is_held(const GoalIkProblem& problem, Index k) noexcept { return ((problem.held_mask >> k) & 1u) != 0; }

ThetaVector first_start(const RobotTable& table, const GoalIkProblem& problem) noexcept {
  ThetaVector theta{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = table.segment[k / 2].theta_limit_rad;
    theta[k] = is_held(problem, k) ? problem.held_rad[k] : clamp(problem.from_rad[k], -limit, limit);
  }
  return theta;
}

ThetaVector random_pose(const RobotTable& table, const GoalIkProblem& problem, std::uint64_t& random) noexcept {
  ThetaVector theta{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
    theta[k] = is_held(problem, k) ? problem.held_rad[k] : 0.9 * table.segment[k / 2].theta_limit_rad * next_random(random);
  return theta;
}

// The random pose whose tip is nearest to the goal.
ThetaVector next_start(const RobotTable& table, const GoalIkProblem& problem, std::uint64_t& random) noexcept {
  ThetaVector best{};
  double least = 1e300;
  for (std::int32_t i = 0; i < kGoalSeeds; ++i) {
    const ThetaVector theta = random_pose(table, problem, random);
    const double size2 = tip_error(table, problem.tip_in_base, theta).size2();
    if (i > 0 && !(size2 < least)) continue;
    least = size2;
    best = theta;
  }
  return best;
}

// Iterates until converged, out of iterations, or no longer halving the error after `patience`; returns the error reached.
TipError iterate(const RobotTable& table, const GoalIkProblem& problem, std::int32_t patience, std::int32_t most, ThetaVector& theta,
                 std::int32_t& iterations) noexcept {
  const IkGoal goal{problem.tip_in_base, problem.held_mask};
  double before2 = 1e300;
  for (std::int32_t i = 0;; ++i, ++iterations) {
    const ArmKinematics arm = forward_kinematics(table, theta);
    const TipError error = tip_error(goal.tip_in_base, arm.tip_in_base);
    const bool slow = i >= patience && !(error.size2() < 0.25 * before2);
    if (error.converged() || slow || i == most) return error;
    before2 = error.size2();
    servo_ik(table, goal, arm, theta);
  }
}

double shape_cost(const RobotTable& table, const GoalIkProblem& problem, const ArmKinematics& arm) noexcept {
  return node_excess_m(table, arm, problem.node);
}

// Step [rad] to the minimum of the shape's model at theta, joint limits included, no theta more than `largest`.
ThetaVector shape_step(const RobotTable& table, const GoalIkProblem& problem, const ArmKinematics& arm, const ThetaVector& theta,
                       double stretch, double largest) noexcept {
  const NullSpace space = null_space(arm.tip_jacobian, table.theta_count(), problem.held_mask);
  ShapeModel model = resting_model(space, 1e-4 * largest_weight(table, problem.node), ThetaVector{});
  add_nodes(table, arm, problem.node, space, model);
  const ShapeFactor metric = factor(space, model);
  NullPoint step;
  step.z = minimum(space, metric, model.pull);
  step.theta_rad = combine(space, step.z);
  double most = largest;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) most = larger(most, stretch * std::fabs(step.theta_rad[k]));
  scale_by(space, stretch * largest / most, step);
  restrict_to(space, metric, room_to_limits(table, theta, 1.0), step);
  return step.theta_rad;
}

bool has_nodes(const RobotTable& table, const GoalIkProblem& problem) noexcept { return largest_weight(table, problem.node) > 0.0; }

}  // namespace

double improve_shape(const RobotTable& table, const GoalIkProblem& problem, ThetaVector& theta_rad, std::int32_t& iterations) noexcept {
  constexpr double kLargestStep_rad = 0.1;
  constexpr double kDone = 1e-5;  // of the sum, per step
  double stretch = 1.0;           // of the model's step
  ArmKinematics arm = forward_kinematics(table, theta_rad);
  double cost = shape_cost(table, problem, arm);
  std::int32_t standing = 0;
  for (std::int32_t i = 0; i < kGoalShapeSteps && stretch > 1e-3 && standing < 3 && cost > 1e-9; ++i) {
    const ThetaVector step = shape_step(table, problem, arm, theta_rad, stretch, kLargestStep_rad);
    ThetaVector candidate = theta_rad;
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
      const double limit = table.segment[k / 2].theta_limit_rad;
      candidate[k] = clamp(theta_rad[k] + step[k], -limit, limit);
    }
    if (iterate(table, problem, 4, 8, candidate, iterations).converged()) {
      const ArmKinematics there = forward_kinematics(table, candidate);
      const double now = shape_cost(table, problem, there);
      if (now < cost) {
        standing = now > (1.0 - kDone) * cost ? standing + 1 : 0;
        theta_rad = candidate, arm = there, cost = now;
        stretch = smaller(4.0, 1.5 * stretch);
        continue;
      }
    }
    stretch *= 0.4;
  }
  return cost;
}

GoalIkResult solve_goal(const RobotTable& table, const GoalIkProblem& problem) noexcept {
  GoalIkResult result;
  TipError best{1e300, 1e300};
  double least_cost = 1e300;
  std::uint64_t random = 0x9E3779B97F4A7C15ULL;
  const std::int32_t wanted = has_nodes(table, problem) ? kGoalShapeStarts : 1;
  std::int32_t found = 0;
  for (std::int32_t attempt = 0; attempt < kGoalAttempts && found < wanted; ++attempt) {
    ThetaVector theta = attempt == 0 ? first_start(table, problem) : next_start(table, problem, random);
    const TipError error = iterate(table, problem, kGoalIterations, kGoalMostIterations, theta, result.iterations);
    if (!error.converged()) {
      if (found == 0 && (attempt == 0 || error.size2() < best.size2())) best = error, result.theta_rad = theta;
      continue;
    }
    ++found;
    const double cost = wanted > 1 ? improve_shape(table, problem, theta, result.iterations) : 0.0;
    if (found == 1 || cost < least_cost) least_cost = cost, result.theta_rad = theta;
  }
  const ArmKinematics arm = forward_kinematics(table, result.theta_rad);
  best = tip_error(problem.tip_in_base, arm.tip_in_base);
  result.converged = best.converged();
  result.position_error_m = best.position_m;
  result.attitude_error_rad = best.attitude_rad;
  for (Index i = 0; i < kMaxNodeTargets; ++i) {
    const NodeTarget& target = problem.node[i];
    if (target.node < 1 || target.node > table.segment_count) continue;
    result.node_distance_m[i] = norm(subtract(target.position_m, arm.node_in_base[static_cast<Index>(target.node)].position_m));
  }
  return result;
}

}  // namespace liana
