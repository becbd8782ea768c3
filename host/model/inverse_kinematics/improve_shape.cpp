#include "host/model/inverse_kinematics/improve_shape.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::inverse_kinematics {
namespace {

using Index = std::size_t;

constexpr double kRestShare = 1e-4;     // m2/rad2 times the largest weight: what keeps undecided directions still
constexpr double kDone = 1e-5;          // of the sum: a smaller gain counts as none
constexpr std::int32_t kTimeout_s = 3;  // steps without gain
constexpr double kLongestStretch =
    4.0;  // of the model's step: its curvature is too large where targets are out of reach

double sum_m(const RobotParams& table, const ShapeProblem& problem, const ThetaVector& theta,
             const ArmKinematics& arm) noexcept {
  return node_excess_m(table, arm, problem.node) + missing_clearance_m(table, theta, arm, problem.clear);
}

double largest_weight(const RobotParams& table, const ShapeProblem& problem) noexcept {
  double largest = largest_weight(table, problem.node);
  for (const KeepClear& target : problem.clear) {
    if (target.distance_m > 0.0) largest = larger(largest, target.weight);
  }
  return largest;
}

// `stretch` times the step to the minimum of the shape's model at theta, within the joint limits.
ThetaVector model_step(const RobotParams& table, const ShapeProblem& problem, const ArmKinematics& arm,
                       const ThetaVector& theta, double stretch) noexcept {
  const NullSpace space = null_space(arm.tip_jacobian, table.theta_count(), problem.goal.held_mask);
  ShapeModel model = resting_model(space, kRestShare * largest_weight(table, problem), ThetaVector{});
  PullSum pulls;
  add_nodes(table, arm, problem.node, pulls);
  add_clearance(table, theta, arm, problem.clear, pulls);
  add_pulls(space, pulls, model);
  const ShapeFactor metric = factor(space, model);
  NullPoint step;
  step.z = minimum(space, metric, model.pull);
  step.theta_rad = combine(space, step.z);
  double largest = kImproveLargestStep_rad;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
    largest = larger(largest, stretch * std::fabs(step.theta_rad[k]));
  scale_by(space, stretch * kImproveLargestStep_rad / largest, step);
  HeldBounds held;
  restrict_to(space, metric, room_to_limits(table, theta, 1.0), kManyPasses, held, step);
  return step.theta_rad;
}

ThetaVector moved(const RobotParams& table, const ThetaVector& theta, const ThetaVector& step) noexcept {
  ThetaVector out{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = table.segment[k / 2].theta_limit_rad;
    out[k] = clamp(theta[k] + step[k], -limit, limit);
  }
  return out;
}

}  // namespace

TipError tip_error(const Pose& goal, const Pose& tip) noexcept {
  const auto e = pose_error(goal, tip);
  return {norm({e[0], e[1], e[2]}), norm({e[3], e[4], e[5]})};
}

TipError approach_tip(const RobotParams& table, const IkGoal& goal, std::int32_t patience, std::int32_t most,
                      ThetaVector& theta_rad, std::int32_t& iterations) noexcept {
  double before2 = 1e300;
  for (std::int32_t i = 0;; ++i, ++iterations) {
    const ArmKinematics arm = forward_kinematics(table, theta_rad);
    const TipError error = tip_error(goal.tip_in_base, arm.tip_in_base);
    const bool slow = i >= patience && !(error.size2() < 0.25 * before2);
    if (error.converged() || slow || i == most) return error;
    before2 = error.size2();
    servo_ik(table, goal, arm, theta_rad);
  }
}

bool wants_shape(const RobotParams& table, const ShapeProblem& problem) noexcept {
  return largest_weight(table, problem) > 0.0;
}

double shape_sum_m(const RobotParams& table, const ShapeProblem& problem, const ThetaVector& theta_rad) noexcept {
  return sum_m(table, problem, theta_rad, forward_kinematics(table, theta_rad));
}

double improve_shape(const RobotParams& table, const ShapeProblem& problem, ThetaVector& theta_rad,
                     std::int32_t& iterations) noexcept {
  ArmKinematics arm = forward_kinematics(table, theta_rad);
  double sum = sum_m(table, problem, theta_rad, arm), stretch = 1.0;
  std::int32_t standing = 0;
  for (std::int32_t i = 0; i < kImproveSteps && stretch > 1e-3 && standing < kTimeout_s && sum > 1e-9; ++i) {
    ThetaVector candidate = moved(table, theta_rad, model_step(table, problem, arm, theta_rad, stretch));
    const TipError error =
        approach_tip(table, problem.goal, kImproveIterations, kImproveIterations, candidate, iterations);
    const ArmKinematics there = forward_kinematics(table, candidate);
    const double less = sum_m(table, problem, candidate, there);
    if (!error.converged() || !(less < sum)) {
      stretch *= 0.4;
      continue;
    }
    standing = less > (1.0 - kDone) * sum ? standing + 1 : 0;
    theta_rad = candidate, arm = there, sum = less;
    stretch = smaller(kLongestStretch, 1.5 * stretch);
  }
  return sum;
}

NodeReach node_reach(const RobotParams& table, const IkGoal& goal, const ThetaVector& theta_rad, std::int32_t node,
                     const Vec3& target_m) noexcept {
  ShapeProblem problem{goal, {}, {}};
  problem.node[0] = {node, target_m, 1.0, 0.0};
  ThetaVector theta = theta_rad;
  std::int32_t iterations = 0;
  NodeReach reach;
  reach.now_m = shape_sum_m(table, problem, theta);
  reach.least_m = improve_shape(table, problem, theta, iterations);
  return reach;
}

}  // namespace liana::inverse_kinematics
