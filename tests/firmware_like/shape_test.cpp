// Shape control in the null space of the tip.
#include "firmware_like/cable/shape/shape.hpp"

#include <gtest/gtest.h>

#include "host/model/inverse_kinematics/improve_shape.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using namespace inverse_kinematics;

using zhu2022::kX4AndX5;
using zhu2022::kX5;
using zhu2022::Random;

ArmKinematics arm_at(const RobotParams& robot, const ThetaVector& theta) { return forward_kinematics(robot, theta); }

double tip_rate(const Jacobian& J, const ThetaVector& v) {
  Vec3 linear{}, angular{};
  for (std::size_t k = 0; k < kMaxTheta; ++k) {
    linear = add(linear, scale(J.linear[k], v[k]));
    angular = add(angular, scale(J.angular[k], v[k]));
  }
  return std::sqrt(dot(linear, linear) + dot(angular, angular));
}

NodeTargets target_of(std::int32_t node, const Vec3& position_m, double weight = 1.0, double threshold_m = 0.0) {
  NodeTargets targets{};
  targets[0] = {node, position_m, weight, threshold_m};
  return targets;
}

void count_on(ShapeState& shape) { shape.tick = (shape.tick + 1) % kShapeTicks; }

double distance_m(const RobotParams& robot, const ThetaVector& theta, const NodeTarget& target) {
  return norm(
      subtract(target.position_m, arm_at(robot, theta).node_in_base[static_cast<std::size_t>(target.node)].position_m));
}

// Shape motion for `ticks` with the tip brought back by the servo IK, as the tick does it.
void run(const RobotParams& robot, const NodeTargets& nodes, std::uint32_t held, std::int32_t ticks,
         ThetaVector& theta) {
  const IkGoal goal{arm_at(robot, theta).tip_in_base, held};
  ShapeState shape;
  for (std::int32_t i = 0; i < ticks; ++i) {
    const ArmKinematics arm = arm_at(robot, theta);
    theta = zhu2022::plus(theta, shape_move(robot, arm, nodes, {}, held, kShapeBesideTip, theta, shape));
    count_on(shape);
    servo_ik(robot, goal, arm, theta);
  }
}

// req:A45
TEST(Shape, TheMiddleNodeComesFirstUnlessWeightsSayOtherwise) {
  const RobotParams robot = zhu2022::table();
  for (const std::int32_t node : {1, 2, 4, 5})
    EXPECT_LT(default_node_weight(robot, node), default_node_weight(robot, 3));
}

// A true projector, not a damped inverse.
// req:A43
TEST(Shape, ProjectedVectorsDoNotMoveTheTip) {
  const RobotParams robot = zhu2022::table();
  Random random(1);
  for (const std::uint32_t held : {0u, kX5, kX4AndX5, (1u << 3) | kX4AndX5}) {
    for (std::int32_t i = 0; i < 300; ++i) {
      const double bend_deg =
          i == 0 ? 0.0 : (i < 50 ? std::pow(10.0, random.uniform(-6.0, 0.0)) : 20.0);  // nearly straight, too
      const Jacobian J = arm_at(robot, random.theta(robot, bend_deg)).tip_jacobian;
      const NullSpace space = null_space(J, robot.theta_count(), held);
      const ThetaVector v = random.theta(robot, 57.0);
      const ThetaVector projected = project(space, v);
      ASSERT_LE(tip_rate(J, projected), 1e-9 * zhu2022::length(projected));
      ASSERT_LE(zhu2022::largest_difference(project(space, projected), projected), 1e-12);  // P P = P
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) ASSERT_TRUE(((held >> k) & 1u) == 0 || projected[k] == 0.0);
    }
  }
}

TEST(Shape, TheNullSpaceHasTheDimensionThatTheTipLeaves) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector bent = Random(2).theta(robot, 15.0);
  for (const auto& [held, dimension] :
       {std::pair{0u, 4}, std::pair{kX5, 3}, std::pair{kX4AndX5, 2}, std::pair{0x3F8u, 0}}) {
    EXPECT_EQ(null_space(arm_at(robot, bent).tip_jacobian, robot.theta_count(), held).dimension, dimension) << held;
  }
  // The straight arm can neither stretch nor roll: four directions are left to the tip, six to the shape.
  EXPECT_EQ(null_space(arm_at(robot, ThetaVector{}).tip_jacobian, robot.theta_count(), 0).dimension, 6);
}

TEST(Shape, ProjectionIsSymmetricSoThatDescentStaysDescent) {
  const RobotParams robot = zhu2022::table();
  Random random(3);
  for (std::int32_t i = 0; i < 100; ++i) {
    const NullSpace space = null_space(arm_at(robot, random.theta(robot, 20.0)).tip_jacobian, robot.theta_count(), kX5);
    const ThetaVector a = random.theta(robot, 57.0), b = random.theta(robot, 57.0), pa = project(space, a),
                      pb = project(space, b);
    double left = 0.0, right = 0.0;
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) left += pa[k] * b[k], right += a[k] * pb[k];
    ASSERT_NEAR(left, right, 1e-12);
  }
}

// The pull of a model at rest is the negative gradient of the weighted excesses along the null space.
TEST(Shape, TheModelsPullIsDownhill) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  NodeTargets nodes = target_of(3, {1.0, 0.2, 0.5}, 2.0);
  nodes[1] = {1, {0.7, -0.1, 0.3}, 0.5, 0.05};
  const ArmKinematics arm = arm_at(robot, theta);
  EXPECT_NEAR(node_excess_m(robot, arm, nodes),
              2.0 * distance_m(robot, theta, nodes[0]) + 0.5 * (distance_m(robot, theta, nodes[1]) - 0.05), 1e-12);
  const NullSpace space = null_space(arm.tip_jacobian, robot.theta_count(), 0);
  ShapeModel model = resting_model(space, 1.0, ThetaVector{});
  PullSum pulls;
  add_nodes(robot, arm, nodes, pulls);
  add_pulls(space, pulls, model);
  constexpr double kStep = 1e-6;
  for (std::size_t d = 0; d < static_cast<std::size_t>(space.dimension); ++d) {
    NullVector unit{};
    unit[d] = kStep;
    const ThetaVector step = combine(space, unit);
    const double more = node_excess_m(robot, arm_at(robot, zhu2022::plus(theta, step)), nodes);
    const double less = node_excess_m(robot, arm_at(robot, zhu2022::plus(theta, step, -1.0)), nodes);
    EXPECT_NEAR(model.pull[d], -(more - less) / (2 * kStep), 1e-6) << d;
  }
}

// Nothing happens within the threshold.
// req:A43
TEST(Shape, OnlyNodesBeyondTheirThresholdCount) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const ArmKinematics arm = arm_at(robot, theta);
  const Vec3 at = arm.node_in_base[3].position_m;
  const Vec3 near = add(at, {0.0, 0.0, 0.05});
  EXPECT_NEAR(node_excess_m(robot, arm, target_of(3, near, 1.0, 0.04)), 0.01, 1e-12);
  const NullSpace space = null_space(arm.tip_jacobian, robot.theta_count(), 0);
  for (const NodeTargets& nodes : {target_of(3, near, 1.0, 0.06), target_of(3, at), target_of(0, near),
                                   target_of(6, near), target_of(3, near, 0.0)}) {
    EXPECT_EQ(node_excess_m(robot, arm, nodes), 0.0);
    ShapeModel model = resting_model(space, 1.0, ThetaVector{});
    PullSum pulls;
    add_nodes(robot, arm, nodes, pulls);
    add_pulls(space, pulls, model);
    for (std::size_t d = 0; d < static_cast<std::size_t>(space.dimension); ++d) EXPECT_EQ(model.pull[d], 0.0);
  }
}

// Towards a target that another shape with the same tip has, up to the balance with centring.
// req:A42 req:A43
TEST(Shape, TheNodeDistanceFallsWhileTheTipStays) {
  const RobotParams robot = zhu2022::table();
  ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  ThetaVector other = theta;
  run(robot, target_of(3, add(arm_at(robot, theta).node_in_base[3].position_m, {0.3, 0.1, 0.2})), 0, 1500, other);
  const NodeTargets nodes = target_of(3, arm_at(robot, other).node_in_base[3].position_m, 1.0, 0.005);
  const Pose tip = arm_at(robot, theta).tip_in_base;
  const double before_m = distance_m(robot, theta, nodes[0]);
  ASSERT_GT(before_m, 0.05);
  double last_m = before_m;
  for (std::int32_t second = 0; second < 14; ++second) {
    run(robot, nodes, 0, 250, theta);
    const double now_m = distance_m(robot, theta, nodes[0]);
    EXPECT_LE(now_m, last_m + 1e-4) << second;
    EXPECT_LE(zhu2022::length(pose_error(tip, arm_at(robot, theta).tip_in_base)), 1e-6);
    last_m = now_m;
  }
  EXPECT_LE(last_m, 0.4 * before_m) << before_m;
}

// Weights decide between targets that contradict each other: node 3 with the larger weight wins.
// req:A44
TEST(Shape, TheHeavierNodeComesCloser) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector start = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const ArmKinematics arm = arm_at(robot, start);
  std::array<double, 2> third_m{}, second_m{};
  for (std::size_t i = 0; i < 2; ++i) {
    NodeTargets nodes = target_of(3, add(arm.node_in_base[3].position_m, {0.0, 0.0, 0.3}), i == 0 ? 5.0 : 0.2);
    nodes[1] = {2, add(arm.node_in_base[2].position_m, {0.0, 0.0, -0.3}), i == 0 ? 0.2 : 5.0, 0.0};
    ThetaVector theta = start;
    run(robot, nodes, 0, 3000, theta);
    third_m[i] = distance_m(robot, theta, nodes[0]);
    second_m[i] = distance_m(robot, theta, nodes[1]);
  }
  EXPECT_LT(third_m[0], third_m[1] - 0.02);
  EXPECT_LT(second_m[1], second_m[0] - 0.02);
}

TEST(Shape, MovesStayWithinLimitsAndBelowTheirShareOfTheRate) {
  const RobotParams robot = zhu2022::table();
  Random random(4);
  for (std::int32_t i = 0; i < 100; ++i) {
    ThetaVector theta = random.theta(robot, 20.0);
    ShapeState shape;
    for (std::size_t k = 0; k < 4; ++k) {
      const double limit = robot.segment[0].theta_limit_rad - (i % 2 == 0 ? 0.0 : 1e-4);
      theta[k] = k % 2 == 0 ? limit : -limit;
    }
    const NodeTargets nodes = target_of(1 + i % 4, random.vector(3.0), 1.0);
    for (std::int32_t tick = 0; tick < 100; ++tick) {
      const ThetaVector move = shape_move(robot, arm_at(robot, theta), nodes, {}, kX5, kShapeBesideTip, theta, shape);
      count_on(shape);
      theta = zhu2022::plus(theta, move);
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
        ASSERT_LE(std::fabs(move[k]), robot.limits.theta_rate_rad_s * robot.tick_s * (1.0 + 1e-9)) << k;
        // What smoothing leaves over the limit, at most a hundredth of a degree, the limiter takes off.
        ASSERT_LE(std::fabs(theta[k]), robot.segment[k / 2].theta_limit_rad + 0.01 * kDegree) << k;
      }
      ASSERT_EQ(move[8], 0.0);
    }
  }
}

// The pitch of the segment that enters the slit next is drawn to zero more than the others.
TEST(Shape, ThePitchAheadOfThePlanarPartComesIntoThePlaneFirst) {
  const RobotParams robot = zhu2022::table();
  ThetaVector theta = zhu2022::radians({3, 2, -4, 3, 3, -2, 4, -5, 0, 3});
  const ThetaVector start = theta;
  ThetaVector without_lead = start;
  run(robot, {}, kX5, 2500, theta);
  run(robot, {}, 0, 2500, without_lead);
  EXPECT_LT(std::fabs(theta[6]), 0.3 * std::fabs(start[6]));
  EXPECT_LT(std::fabs(theta[6]), std::fabs(without_lead[6]));
  EXPECT_EQ(theta[8], start[8]);
}

// At every kind of pose: nearly straight, at limits, with rival nodes, with held thetas.
// req:A43
TEST(Shape, TheMoveOfATickDoesNotMoveTheTip) {
  const RobotParams robot = zhu2022::table();
  Random random(5);
  for (const std::uint32_t held : {0u, kX5, kX4AndX5}) {
    for (std::int32_t i = 0; i < 200; ++i) {
      ThetaVector theta = random.theta(robot, i % 2 == 0 ? 20.0 : std::pow(10.0, random.uniform(-6.0, 0.0)));
      if (i % 4 == 0) theta[0] = theta[3] = 20.0 * kDegree;
      ShapeState shape;
      NodeTargets nodes = target_of(3, random.vector(2.0));
      nodes[1] = {2, random.vector(2.0), 0.5, 0.01};
      const ArmKinematics arm = arm_at(robot, theta);
      const NullSpace space = null_space(arm.tip_jacobian, robot.theta_count(), held);
      shape.rate_rad_s = combine(space, coordinates(space, random.theta(robot, 0.5)));
      const ThetaVector move = shape_move(robot, arm, nodes, {}, held, kShapeBesideTip, theta, shape);
      ASSERT_LE(tip_rate(arm.tip_jacobian, move), 1e-9 * zhu2022::length(move)) << i;
    }
  }
}

// No null-space point within bounds is nearer, in the metric of the model, than the one found.
TEST(Shape, LimitsAreBoundsOfTheSameProblem) {
  const RobotParams robot = zhu2022::table();
  Random random(6);
  std::int32_t bounded = 0;
  for (std::int32_t i = 0; i < 300; ++i) {
    ThetaVector theta = random.theta(robot, 15.0);
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
      if (random.uniform(0.0, 1.0) < 0.3)
        theta[k] = (theta[k] > 0.0 ? 1.0 : -1.0) * random.uniform(19.9, 20.0) * kDegree;
    }
    const ArmKinematics arm = arm_at(robot, theta);
    const NullSpace space = null_space(arm.tip_jacobian, robot.theta_count(), 0);
    ShapeModel model = resting_model(space, 0.01, random.theta(robot, 10.0));
    PullSum pulls;
    add_nodes(robot, arm, target_of(3, random.vector(2.0)), pulls);
    add_pulls(space, pulls, model);
    const ShapeFactor metric = factor(space, model);
    const ThetaBounds bounds = room_to_limits(robot, theta, 1.0);
    const NullVector free = minimum(space, metric, model.pull);
    NullPoint found{free, combine(space, free)};
    HeldBounds held;
    restrict_to(space, metric, bounds, kManyPasses, held, found);
    bounded += found.z == free ? 0 : 1;
    const std::size_t m = static_cast<std::size_t>(space.dimension);
    NullVector slope{};  // of the model at what was found
    for (std::size_t a = 0; a < m; ++a) {
      slope[a] = -model.pull[a];
      for (std::size_t b = 0; b < m; ++b)
        slope[a] += (a >= b ? model.curvature[a][b] : model.curvature[b][a]) * found.z[b];
    }
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
      ASSERT_LE(found.theta_rad[k], bounds.high[k] + 1e-10);
      ASSERT_GE(found.theta_rad[k], bounds.low[k] - 1e-10);
    }
    for (std::int32_t trial = 0; trial < 50; ++trial) {
      NullPoint other{coordinates(space, zhu2022::plus(found.theta_rad, random.theta(robot, 3.0))), {}};
      other.theta_rad = combine(space, other.z);
      HeldBounds unknown;
      restrict_to(space, bounds, kManyPasses, unknown, other);
      double gain = 0.0;
      for (std::size_t a = 0; a < m; ++a) gain += slope[a] * (other.z[a] - found.z[a]);
      ASSERT_GE(gain, -1e-7) << i;
    }
  }
  EXPECT_GE(bounded, 100);  // the test has something to test
}

// 500 cases against the best of 50 solves by tests/numbers/planning_shape.cpp.
// req:A44
TEST(Shape, TheTickEndsWhereTheOfflineSolveFromTheSameStartEnds) {
  const RobotParams robot = zhu2022::table();
  Random random(7);
  std::int32_t same = 0;
  for (std::int32_t i = 0; i < 10; ++i) {
    const ThetaVector start = random.theta(robot, 15.0);
    const ArmKinematics arm = arm_at(robot, start);
    ShapeProblem problem{
        {arm.tip_in_base, 0}, target_of(3, add(arm.node_in_base[3].position_m, random.vector(0.2))), {}};
    problem.node[1] = {2, add(arm.node_in_base[2].position_m, random.vector(0.2)), 0.5, i % 2 == 0 ? 0.0 : 0.02};
    ThetaVector offline = start, theta = start;
    std::int32_t iterations = 0;
    const double least_m = improve_shape(robot, problem, offline, iterations);
    run(robot, problem.node, 0, 15000, theta);
    EXPECT_LE(zhu2022::length(pose_error(arm.tip_in_base, arm_at(robot, theta).tip_in_base)), 1e-6);
    same += shape_sum_m(robot, problem, theta) <= 1.01 * least_m + 1e-4 ? 1 : 0;
  }
  EXPECT_GE(same, 8);
}

// A target that jumps to and fro, into limits and back: rates change by no more than their share of the acceleration.
TEST(Shape, MotionIsSmoothWhateverTheTargetsDo) {
  const RobotParams robot = zhu2022::table();
  Random random(8);
  const double accel = kShapeBesideTip.accel_share * robot.limits.theta_accel_rad_s2 * robot.tick_s;
  for (std::int32_t i = 0; i < 10; ++i) {
    ThetaVector theta = random.theta(robot, 18.0);
    ShapeState shape;
    const IkGoal goal{arm_at(robot, theta).tip_in_base, 0};
    NodeTargets nodes{};
    for (std::int32_t tick = 0; tick < 5000; ++tick) {
      if (tick % 700 == 0) nodes = target_of(2 + i % 3, random.vector(3.0));
      const ThetaVector before = shape.rate_rad_s;
      const ArmKinematics arm = arm_at(robot, theta);
      theta = zhu2022::plus(theta, shape_move(robot, arm, nodes, {}, 0, kShapeBesideTip, theta, shape));
      count_on(shape);
      servo_ik(robot, goal, arm, theta);
      ASSERT_LE(zhu2022::largest_difference(shape.rate_rad_s, before), 2.2 * accel) << i << " " << tick;
    }
  }
}

// Three segments leave the tip nothing to spare; eight leave ten directions.
TEST(Shape, ArmsOfOtherSizesKeepTheirTipToo) {
  Random random(9);
  RobotParams eight = zhu2022::table();
  eight.segment_count = 8;
  for (std::size_t m = 5; m < 8; ++m) eight.segment[m] = zhu2022::segment(8, 3, 24.0 * static_cast<double>(m));
  for (const RobotParams& robot : {zhu2022::uneven_table(), eight}) {
    const ThetaVector theta = random.theta(robot, 15.0);
    ShapeState shape;
    const ArmKinematics arm = arm_at(robot, theta);
    const NodeTargets nodes = target_of(2, add(arm.node_in_base[2].position_m, {0.0, 0.0, 0.2}));
    ThetaVector move{};
    for (std::uint32_t tick = 0; tick < 2 * kShapeTicks; ++tick) {
      move = shape_move(robot, arm, nodes, {}, 0, kShapeBesideTip, theta, shape);
      count_on(shape);
    }
    EXPECT_LE(tip_rate(arm.tip_jacobian, move), 1e-9 * zhu2022::length(move));
    EXPECT_EQ(zhu2022::length(move) > 0.0, robot.segment_count == 8);
    EXPECT_EQ(null_space(arm.tip_jacobian, robot.theta_count(), 0).dimension, robot.theta_count() - 6);
  }
}

}  // namespace
}  // namespace liana::cable
