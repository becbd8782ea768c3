// Clearance as an aim of the shape.
#include "firmware_like/cable/shape/keep_clear.hpp"

#include <gtest/gtest.h>

#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using namespace inverse_kinematics;

using zhu2022::Random;

// Least distance of every link to a point, segment by segment, from the link points alone.
double missing_from_points_m(const RobotParams& robot, const ThetaVector& theta, const KeepClear& target) {
  const LinkPoints points = link_points(robot, theta);
  double sum_m = 0.0;
  std::size_t link = 0;
  for (std::size_t m = 0; m < static_cast<std::size_t>(robot.segment_count); ++m) {
    double least_m = 1e300;
    for (std::int32_t i = 0; i < robot.segment[m].modules; ++i, ++link) {
      for (std::int32_t part = 0; part <= 1000; ++part) {
        const Vec3 from = points.point_in_base[link], along = subtract(points.point_in_base[link + 1], from);
        least_m = std::min(least_m, norm(subtract(add(from, scale(along, part / 1000.0)), target.centre_m)));
      }
    }
    sum_m += target.weight * std::max(0.0, target.distance_m - least_m);
  }
  return sum_m;
}

KeepClearTargets one(const Vec3& centre_m, double distance_m, double weight = 1.0) {
  KeepClearTargets targets{};
  targets[0] = {centre_m, distance_m, weight};
  return targets;
}

TEST(KeepClear, MissingClearanceIsThatOfTheLinkPoints) {
  Random random(1);
  for (const RobotParams& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    for (std::int32_t i = 0; i < 10; ++i) {
      const ThetaVector theta = random.theta(robot, 15.0);
      const KeepClearTargets targets = one(random.vector(1.5), 1.0, 0.7);
      EXPECT_NEAR(missing_clearance_m(robot, theta, forward_kinematics(robot, theta), targets),
                  missing_from_points_m(robot, theta, targets[0]), 1e-5);
    }
  }
}

// Curvature 1 at rest and one push: the model's pull is the negative gradient of the sum of missing clearances.
TEST(KeepClear, ThePullIsTheNegativeGradient) {
  Random random(2);
  constexpr double kStep = 1e-6;
  for (const RobotParams& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    for (std::int32_t i = 0; i < 20; ++i) {
      const ThetaVector theta = random.theta(robot, 15.0);
      const ArmKinematics arm = forward_kinematics(robot, theta);
      const NullSpace space = null_space(arm.tip_jacobian, robot.theta_count(), 0);
      const KeepClearTargets targets = one(random.vector(1.5), 1.0);
      ShapeModel model = resting_model(space, 1.0, ThetaVector{});
      PullSum pulls;
      add_clearance(robot, theta, arm, targets, pulls);
      add_pulls(space, pulls, model);
      for (std::int32_t d = 0; d < space.dimension; ++d) {
        ThetaVector more = theta, less = theta;
        for (std::int32_t k = 0; k < robot.theta_count(); ++k) {
          more[static_cast<std::size_t>(k)] += kStep * space.component(d, k);
          less[static_cast<std::size_t>(k)] -= kStep * space.component(d, k);
        }
        const double slope = (missing_clearance_m(robot, more, forward_kinematics(robot, more), targets) -
                              missing_clearance_m(robot, less, forward_kinematics(robot, less), targets)) /
                             (2.0 * kStep);
        EXPECT_NEAR(model.pull[static_cast<std::size_t>(d)], -slope, 1e-4) << d;
      }
    }
  }
}

TEST(KeepClear, TheArmsMiddleMakesWayWhileTheTipStays) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector start = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const ArmKinematics arm = forward_kinematics(robot, start);
  ShapeProblem problem{{arm.tip_in_base, 0}, {}, {}};
  problem.clear = one(add(arm.node_in_base[3].position_m, {0.0, 0.0, 0.05}), 0.2);
  ThetaVector theta = start;
  std::int32_t iterations = 0;
  ASSERT_GT(shape_sum_m(robot, problem, theta), 0.1);
  EXPECT_LT(improve_shape(robot, problem, theta, iterations), 1e-4);
  EXPECT_LT(missing_from_points_m(robot, theta, problem.clear[0]), 1e-3);
  EXPECT_TRUE(tip_error(problem.goal.tip_in_base, forward_kinematics(robot, theta).tip_in_base).converged());
}

TEST(KeepClear, TheTickPushesTheArmsMiddleAwayWithinItsRatesWhileTheTipStays) {
  const RobotParams robot = zhu2022::table();
  ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  ShapeState shape;
  const ArmKinematics start = forward_kinematics(robot, theta);
  const KeepClearTargets clear = one(add(start.node_in_base[3].position_m, {0.0, 0.0, 0.05}), 0.2);
  const IkGoal goal{start.tip_in_base, 0};
  const double missing_m = missing_clearance_m(robot, theta, start, clear);
  double largest_rate = 0.0;
  for (std::int32_t tick = 0; tick < 60 * 250; ++tick) {
    const ArmKinematics arm = forward_kinematics(robot, theta);
    theta = zhu2022::plus(theta, shape_move(robot, arm, {}, clear, 0, kShapeBesideTip, theta, shape));
    shape.tick = (shape.tick + 1) % kShapeTicks;
    servo_ik(robot, goal, arm, theta);
    for (const double r : shape.rate_rad_s) largest_rate = std::max(largest_rate, std::fabs(r));
  }
  EXPECT_GT(missing_m, 0.1);
  EXPECT_LT(missing_from_points_m(robot, theta, clear[0]), 2e-3);
  EXPECT_LE(largest_rate, kShapeBesideTip.rate_share * robot.limits.theta_rate_rad_s * (1.0 + 1e-12));
  EXPECT_LT(zhu2022::length(pose_error(start.tip_in_base, forward_kinematics(robot, theta).tip_in_base)), 1e-6);
}

TEST(KeepClear, TheGoalIkFindsAShapeThatKeepsClear) {
  const RobotParams robot = zhu2022::table();
  Random random(3);
  std::int32_t clear = 0;
  for (std::int32_t i = 0; i < 20; ++i) {
    GoalIkProblem problem;
    problem.from_rad = random.theta(robot, 12.0);
    const ArmKinematics arm = forward_kinematics(robot, problem.from_rad);
    problem.tip_in_base = arm.tip_in_base;
    problem.clear = one(add(arm.node_in_base[2].position_m, random.vector(0.03)), 0.15);
    const GoalIkResult result = solve_goal(robot, problem);
    ASSERT_TRUE(result.converged);
    clear += missing_from_points_m(robot, result.theta_rad, problem.clear[0]) < 1e-3 ? 1 : 0;
  }
  EXPECT_GE(clear, 18);
}

TEST(KeepClear, UnusedFarAndCoincidentTargetsPushNothing) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector theta{};
  const ArmKinematics arm = forward_kinematics(robot, theta);
  const NullSpace space = null_space(arm.tip_jacobian, robot.theta_count(), 0);
  for (const KeepClear& target :
       {KeepClear{}, KeepClear{{0.0, 5.0, 0.0}, 0.5, 1.0}, KeepClear{{1.0, 0.0, 0.0}, 0.5, 0.0}}) {
    KeepClearTargets targets{};
    targets[3] = target;
    EXPECT_EQ(missing_clearance_m(robot, theta, arm, targets), 0.0);
  }
  ShapeModel model = resting_model(space, 1.0, ThetaVector{});
  PullSum pulls;
  add_clearance(robot, theta, arm, one({1.25, 0.0, 0.0}, 0.1), pulls);  // on the axis: no direction leads away
  add_pulls(space, pulls, model);
  for (std::int32_t d = 0; d < space.dimension; ++d) EXPECT_EQ(model.pull[static_cast<std::size_t>(d)], 0.0);
}

}  // namespace
}  // namespace liana::cable
