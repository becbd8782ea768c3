// Servo IK: convergence, exact limits, variables held to the last bit, calm at singular poses.
#include "firmware_like/cable/motion/servo_ik.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/pose_of_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::kX4AndX5;
using zhu2022::kX5;
using zhu2022::Random;

Pose tip_at(const RobotParams& robot, const ThetaVector& theta) { return forward_kinematics(robot, theta).tip_in_base; }

IkResult run(const RobotParams& robot, const IkGoal& goal, std::int32_t steps, ThetaVector& theta) {
  IkResult report;
  for (std::int32_t i = 0; i < steps; ++i) report = ik_step(robot, goal, kDamping, theta);
  return report;
}

bool within_limits(const RobotParams& robot, const ThetaVector& theta) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(robot.theta_count()); ++k) {
    if (!(std::fabs(theta[k]) <= robot.segment[k / 2].theta_limit_rad)) return false;
  }
  return true;
}

// req:A37 req:A38
TEST(ServoIk, ConvergesFromNearbyWithTenNineAndEightVariables) {
  const RobotParams robot = zhu2022::table();
  for (const std::uint32_t held : {0u, kX5, kX4AndX5}) {
    Random random(1);
    for (std::int32_t i = 0; i < 100; ++i) {
      ThetaVector goal_theta = random.theta(robot, 15.0);
      ThetaVector theta = zhu2022::plus(goal_theta, random.theta(robot, 0.3));
      for (std::size_t k : {6u, 8u}) goal_theta[k] = theta[k] = 0.0;
      const IkGoal goal{tip_at(robot, goal_theta), held};
      run(robot, goal, 60, theta);
      ASSERT_LE(error_of(robot, goal.tip_in_base, theta), 1e-8) << i << " " << held;
    }
  }
}

TEST(ServoIk, WorksOnAnotherArm) {
  const RobotParams robot = zhu2022::uneven_table();
  const ThetaVector goal_theta = Random(2).theta(robot, 10.0);
  ThetaVector theta = zhu2022::plus(goal_theta, Random(3).theta(robot, 0.1));
  const Pose goal = tip_at(robot, goal_theta);
  run(robot, {goal, 0}, 200, theta);
  EXPECT_LE(error_of(robot, goal, theta), 1e-8);
}

// Constant, not nearly constant.
// req:A38
TEST(ServoIk, HeldVariablesKeepTheirBits) {
  const RobotParams robot = zhu2022::table();
  Random random(4);
  for (std::int32_t i = 0; i < 200; ++i) {
    ThetaVector theta = random.theta(robot, 20.0);
    const ThetaVector before = theta;
    const auto held = static_cast<std::uint32_t>(random.uniform(1.0, 1024.0));
    run(robot, {tip_at(robot, random.theta(robot, 20.0)), held}, 20, theta);
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
      if (((held >> k) & 1u) != 0) {
        ASSERT_EQ(theta[k], before[k]) << k;
      }
    }
    ASSERT_NE(theta, before);
  }
}

// req:A5
TEST(ServoIk, LimitsAreNeverPassedAndSaidToAct) {
  const RobotParams robot = zhu2022::table();
  Random random(5);
  std::int32_t at_limit = 0;
  for (std::int32_t i = 0; i < 300; ++i) {
    ThetaVector theta = random.theta(robot, 20.0);
    const IkGoal goal{tip_at(robot, random.theta(robot, 20.0)), 0};
    for (std::int32_t k = 0; k < 30; ++k) {
      const IkResult report = ik_step(robot, goal, kDamping, theta);
      ASSERT_TRUE(within_limits(robot, theta)) << i;
      if (report.limit_mask != 0) ++at_limit;
    }
  }
  EXPECT_GT(at_limit, 100);  // far goals do meet limits
}

TEST(ServoIk, AVariableOnItsLimitStandsExactlyOnIt) {
  const RobotParams robot = zhu2022::table();
  RobotParams wide = robot;
  for (auto& segment : wide.segment) segment.theta_limit_rad = 40.0 * kDegree;
  ThetaVector beyond{};
  for (std::size_t k = 0; k < 2; ++k) beyond[k] = 24.0 * kDegree;  // only reachable past the limit
  const Pose goal = tip_at(wide, beyond);
  ThetaVector theta{};
  for (std::size_t k = 0; k < 2; ++k) theta[k] = 19.5 * kDegree;
  const IkResult report = ik_step(robot, {goal, 0}, kDamping, theta);
  EXPECT_NE(report.limit_mask, 0u);
  const double limit = robot.segment[0].theta_limit_rad;
  EXPECT_GE(std::count_if(theta.begin(), theta.end(), [limit](double angle) { return std::fabs(angle) == limit; }), 1);
}

// What a theta on its limit cannot give, the others give in the same step.
TEST(ServoIk, TheOthersTakeOverTheShareOfAVariableOnItsLimit) {
  const RobotParams robot = zhu2022::table();
  Random random(7);
  std::int32_t taken_over = 0;
  for (std::int32_t i = 0; i < 100; ++i) {
    ThetaVector theta = random.theta(robot, 15.0);
    theta[3] = robot.segment[1].theta_limit_rad - 0.05 * kDegree;
    ThetaVector turn = random.theta(robot, 0.05);
    turn[3] = 0.3 * kDegree;
    const Pose goal = tip_at(robot, zhu2022::plus(theta, turn));
    const double before = error_of(robot, goal, theta);
    ThetaVector alone = theta;
    const IkResult report = ik_step(robot, {goal, 0}, 1e-12, alone);
    if (alone[3] != robot.segment[1].theta_limit_rad) continue;
    ++taken_over;
    EXPECT_NE(report.limit_mask, 0u);
    ASSERT_LE(error_of(robot, goal, alone), 0.2 * before) << i;
  }
  EXPECT_GT(taken_over, 20);
}

// The straight arm cannot move its tip along itself: the closed forms and the iteration must stay calm there.
TEST(ServoIk, TheStraightArmNeitherBlowsUpNorDividesByZero) {
  const RobotParams robot = zhu2022::table();
  for (const double size_deg : {0.0, 1e-10, 1e-6, 1e-3}) {
    for (const double along_m : {0.001, -0.001, 0.2, -0.2}) {
      ThetaVector theta = Random(6).theta(robot, size_deg);
      Pose goal = tip_at(robot, theta);
      goal.position_m[0] += along_m;
      for (std::int32_t i = 0; i < 300; ++i) {
        ik_step(robot, {goal, 0}, kDamping, theta);
        ASSERT_TRUE(within_limits(robot, theta)) << size_deg << " " << along_m;  // false for NaN too
      }
    }
  }
}

TEST(ServoIk, TheStraightArmMovesSidewaysAndSaysWhereItCannotGo) {
  const RobotParams robot = zhu2022::table();
  ThetaVector theta{};
  Pose goal = tip_at(robot, theta);
  goal.position_m[1] += 0.01;
  run(robot, {goal, 0}, 60, theta);
  const std::array<double, 6> error = pose_error(goal, tip_at(robot, theta));
  EXPECT_LE(std::fabs(error[1]), 1e-6);
  EXPECT_LE(zhu2022::length(error),
            1e-4);  // the shortening that a bend brings is slow to follow: that direction is singular

  ThetaVector straight{};
  Pose longer = tip_at(robot, straight);
  longer.position_m[0] += 0.1;
  const IkResult report = ik_step(robot, {longer, 0}, kDamping, straight);
  EXPECT_EQ(report.outcome, IkOutcome::kUnreachable);  // longer than the arm is
  EXPECT_EQ(straight, ThetaVector{});
}

// The residual points to where the target is.
// req:A37
TEST(ServoIk, EveryOutcomeIsNamedWithTheDirectionThatIsLeft) {
  const RobotParams robot = zhu2022::table();
  const auto settle = [&](const Pose& goal, ThetaVector theta, std::uint32_t held = 0) {
    IkResult report;
    for (std::int32_t i = 0; i < 400; ++i)
      report = servo_ik(robot, {goal, held}, forward_kinematics(robot, theta), theta);
    return report;
  };
  const ThetaVector bent = zhu2022::radians(zhu2022::kPanelEdge_deg);
  EXPECT_STREQ(ik_outcome_name(settle(tip_at(robot, bent), bent).outcome), "converged");

  ThetaVector beyond = bent;
  beyond[1] = 24.0 * kDegree;
  const IkResult limited = settle(tip_at(robot, beyond), bent, ~2u);  // theta 2 alone may move
  EXPECT_STREQ(ik_outcome_name(limited.outcome), "limited");
  EXPECT_EQ(limited.limit_mask, 2u);

  Pose longer = tip_at(robot, ThetaVector{});
  longer.position_m[0] += 0.1;
  const IkResult unreachable = settle(longer, ThetaVector{});
  EXPECT_STREQ(ik_outcome_name(unreachable.outcome), "unreachable");
  EXPECT_GT(unreachable.residual[0], 0.099);

  Pose shorter = tip_at(robot, ThetaVector{});
  shorter.position_m[0] -= 0.1;
  const IkResult singular = settle(shorter, ThetaVector{});
  EXPECT_STREQ(ik_outcome_name(singular.outcome), "singular");
  EXPECT_LT(singular.residual[0], -0.099);
}

TEST(ServoIk, ReportsTheErrorBeforeTheStep) {
  const RobotParams robot = zhu2022::table();
  ThetaVector theta = zhu2022::radians(zhu2022::kPrepare_deg);
  Pose goal = tip_at(robot, theta);
  goal.position_m[2] += 0.003;
  goal.quaternion = multiply(quaternion_of({0.0, 0.02, 0.0}), goal.quaternion);
  const IkResult report = ik_step(robot, {goal, 0}, kDamping, theta);
  EXPECT_NEAR(report.position_error_m, 0.003, 1e-12);
  EXPECT_NEAR(report.attitude_error_rad, 0.02, 1e-12);
  EXPECT_LT(error_of(robot, goal, theta), 0.005);
}

// The path of a moving tip at full speed, as the tick does it.
TEST(ServoIk, FollowsATipAtFullSpeedToMicrometres) {
  const RobotParams robot = zhu2022::table();
  ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  Pose goal = tip_at(robot, theta);
  for (std::int32_t i = 0; i < 500; ++i) {
    goal.position_m[0] += robot.limits.tip_speed_m_s * robot.tick_s;
    servo_ik(robot, {goal, 0}, forward_kinematics(robot, theta), theta);
    ASSERT_LE(error_of(robot, goal, theta), 1e-6) << i;
  }
}

}  // namespace
}  // namespace liana::cable
