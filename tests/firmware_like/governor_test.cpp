// The governor: what it leaves of the tip's accelerations and speeds where cables or joints have no more.
#include "firmware_like/cable/motion/governor.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable/motion/servo_ik.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

// What it finds at a pose after it has looked for a while.
GovernorState look(const RobotParams& robot, const ThetaVector& theta_rad) {
  const CableLayout layout = cable_layout(robot);
  const ArmTrig trig = arm_trig(robot, theta_rad);
  const CableGeometry geometry = cable_geometry(robot, layout, trig);
  GovernorState state;
  state.room_N.fill(30.0);
  for (std::uint32_t tick = 0; tick < 60; ++tick)
    look_at_load(robot, geometry, TensionRatio{}, forward_kinematics(robot, theta_rad), 0, tick % 10, state);
  return state;
}

TEST(Governor, WhatJointsAndCablesCanIsLeftToTheTipWhichNeverAsksForMore) {
  const ThetaVector theta_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const RobotParams table = zhu2022::table();
  const GovernorState as_it_is = look(table, theta_rad);
  for (const double share : {0.5, 0.1}) {
    RobotParams slow = table;
    slow.limits.theta_accel_rad_s2 *= share * share;
    const GovernorState by_accel = look(slow, theta_rad);
    EXPECT_LT(by_accel.linear_share, as_it_is.linear_share) << share;
    EXPECT_LT(by_accel.angular_share, as_it_is.angular_share) << share;

    slow = table;
    slow.limits.theta_rate_rad_s *= share;
    const GovernorState by_rate = look(slow, theta_rad);
    EXPECT_EQ(by_rate.linear_share, as_it_is.linear_share) << share;
    EXPECT_LT(by_rate.speed_share, as_it_is.speed_share) << share;
    EXPECT_LT(by_rate.turn_share, as_it_is.turn_share) << share;

    slow = table;
    slow.limits.cable_speed_m_s *= 0.3 * share;
    const GovernorState by_cable = look(slow, theta_rad);
    EXPECT_EQ(by_cable.linear_share, as_it_is.linear_share) << share;
    EXPECT_LT(by_cable.speed_share, as_it_is.speed_share) << share;
    EXPECT_LT(by_cable.turn_share, as_it_is.turn_share) << share;
  }
}

// The tip's way that it leaves, carried out by the free angles that move it least, stays within every joint's rate.
TEST(Governor, TheSpeedThatItLeavesTakesItsShareOfEveryRateAtMost) {
  const RobotParams robot = zhu2022::table();
  zhu2022::Random random(3);
  for (int i = 0; i < 50; ++i) {
    const ThetaVector theta_rad = random.theta(robot, 0.9);
    const GovernorState state = look(robot, theta_rad);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      IkGoal goal;
      goal.tip_in_base = forward_kinematics(robot, theta_rad).tip_in_base;
      Vec3 way_m{};
      way_m[axis] = state.speed_share * robot.limits.tip_speed_m_s * 1e-3;
      goal.tip_in_base.position_m = add(goal.tip_in_base.position_m, slowed(state.slow_ways, way_m));
      ThetaVector moved_rad = theta_rad;
      ik_step(robot, goal, 1e-3, moved_rad);
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k)
        EXPECT_LE(std::fabs(moved_rad[k] - theta_rad[k]), 1.03e-3 * kGovernorTip * robot.limits.theta_rate_rad_s) << i;
    }
    EXPECT_LE(state.speed_share, 1.0);
  }
}

// Towards the straight arm and at it, which cannot turn about its axis (x) nor come nearer.
TEST(Governor, NearTheStraightArmOnlyTheDirectionsThatItLosesAreSlowAndFarMoreThanThePoseComesNear) {
  ThetaVector theta_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  EXPECT_TRUE(is_even(look(zhu2022::table(), theta_rad).slow_ways)) << "far from it";
  double way = 1.0, turn = 1.0;
  for (const double scale : {0.03, 0.015, 0.0}) {
    ThetaVector near_rad = theta_rad;
    for (double& angle : near_rad) angle *= scale;
    const GovernorState state = look(zhu2022::table(), near_rad);
    const Vec3 along = slowed(state.slow_ways, {1.0, 0.0, 0.0}), about = slowed(state.slow_turns, {1.0, 0.0, 0.0});
    EXPECT_GT(state.slow_ways.share[0], 0.0) << scale;
    EXPECT_LT(norm(along), 0.5 * way) << scale;
    EXPECT_LT(norm(about), 0.5 * turn) << scale;
    for (const Vec3& lateral : {Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
      EXPECT_GT(norm(slowed(state.slow_ways, lateral)), 0.99) << scale;
      EXPECT_GT(norm(slowed(state.slow_turns, lateral)), 0.99) << scale;
    }
    EXPECT_GT(state.speed_share, 0.8) << scale;
    way = norm(along);
    turn = norm(about);
  }
}

// A table of slow joints loses no direction.
TEST(Governor, JointsThatAreSlowInEveryDirectionMakeNoneOfThemLost) {
  RobotParams slow = zhu2022::table();
  slow.limits.theta_rate_rad_s *= 0.03;
  const GovernorState state = look(slow, zhu2022::radians(zhu2022::kPanelEdge_deg));
  EXPECT_LT(state.speed_share, kGovernorLost);
  for (const double share : state.slow_ways.share) EXPECT_GT(share, 0.3);
}

}  // namespace
}  // namespace liana::cable
