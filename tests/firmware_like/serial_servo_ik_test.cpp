// Servo IK of the serial arm: it converges, keeps ranges exactly, leaves the tip alone while it uses what the tip
// leaves free, and says how far it got.
#include "firmware_like/serial/servo_ik.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/micro_arm.hpp"
#include "tests/rounds.hpp"

namespace liana::serial {
namespace {

using micro::Random;

Pose tip_at(const RobotParams& robot, const JointVector& joint) { return forward_kinematics(robot, joint).tip_in_base; }

IkResult ticks(const RobotParams& robot, const Pose& goal, std::int32_t count, JointVector& joint) {
  IkResult report;
  for (std::int32_t i = 0; i < count; ++i) report = servo_ik(robot, goal, {}, joint);
  return report;
}

// Goals a few degrees away: what a filtered target asks of a second.
TEST(SerialServoIk, ReachesAtLeast999Of1000NearbyGoals) {
  const RobotParams robot = micro::table();
  Random random(1);
  std::int32_t reached = 0;
  for (std::int32_t i = 0; i < rounds(2000); ++i) {
    const JointVector there = micro::random_joints(robot, random, 0.95);
    JointVector joint = micro::near(robot, there, random, 5.0 * kDegree);
    if (ticks(robot, tip_at(robot, there), 250, joint).outcome == IkOutcome::kConverged) ++reached;
    ASSERT_TRUE(micro::within_ranges(robot, joint));
  }
  EXPECT_GE(reached, rounds(2000) - rounds(2000) / 1000);
}

// Of a tick's way at full tip speed at most a hundredth is left at its end, away from singular poses.
TEST(SerialServoIk, FollowsATicksWayInTheSameTick) {
  const RobotParams robot = micro::table();
  Random random(2);
  const double way_m = robot.tip.speed_m_s * robot.tick_s;
  std::int32_t regular = 0;
  for (std::int32_t i = 0; i < 2000; ++i) {
    JointVector joint = micro::random_joints(robot, random, 0.9);
    if (micro::determinant(robot, forward_kinematics(robot, joint).tip_jacobian) < 2.0) continue;
    ++regular;
    Pose goal = tip_at(robot, joint);
    goal.position_m[static_cast<std::size_t>(i % 3)] += way_m;
    const IkResult report = servo_ik(robot, goal, {}, joint);
    ASSERT_LE(report.position_error_m, 0.01 * way_m) << i;
    ASSERT_LE(report.attitude_error_rad, 0.01 * way_m) << i;
  }
  EXPECT_GT(regular, 500);
}

TEST(SerialServoIk, WorksWithSixJoints) {
  const RobotParams robot = micro::six_joint_table();
  Random random(3);
  std::int32_t reached = 0;
  for (std::int32_t i = 0; i < rounds(200); ++i) {
    const JointVector there = micro::random_joints(robot, random, 0.9);
    JointVector joint = micro::near(robot, there, random, 1.0 * kDegree);
    if (ticks(robot, tip_at(robot, there), 250, joint).outcome == IkOutcome::kConverged) ++reached;
  }
  EXPECT_GE(reached, rounds(190));  // without a spare joint more of them lie behind a singular pose
}

TEST(SerialServoIk, RangesAreNeverLeftAndSaidToAct) {
  const RobotParams robot = micro::six_joint_table();
  Random random(4);
  std::int32_t limited = 0;
  for (std::int32_t i = 0; i < 500; ++i) {
    JointVector joint = micro::random_joints(robot, random);
    const Pose goal = tip_at(robot, micro::random_joints(robot, random));
    for (std::int32_t tick = 0; tick < 50; ++tick) {
      const IkResult report = servo_ik(robot, goal, {}, joint);
      ASSERT_TRUE(micro::within_ranges(robot, joint)) << i;
      for (std::size_t k = 0; k < robot.joints(); ++k) {
        if (((report.limit_mask >> k) & 1u) != 0) ++limited;
      }
    }
  }
  EXPECT_GT(limited, 100);
}

TEST(SerialServoIk, AJointThatAGoalWouldCarryBeyondItsRangeStandsExactlyOnItsEnd) {
  const RobotParams robot = micro::table();
  JointVector joint = micro::radians(micro::kBent_deg);
  RobotParams narrow = robot;
  narrow.joint[3].high_rad = joint[3] + 0.05 * kDegree;
  for (std::size_t i : {0u, 1u, 2u, 4u, 5u, 6u}) {  // the others cannot make up for it
    narrow.joint[i].low_rad = joint[i] - 1e-9;
    narrow.joint[i].high_rad = joint[i] + 1e-9;
  }
  JointVector there = joint;
  there[3] += 1.0 * kDegree;
  const IkResult report = ticks(narrow, tip_at(robot, there), 100, joint);
  EXPECT_EQ(joint[3], narrow.joint[3].high_rad);
  EXPECT_TRUE(((report.limit_mask >> 3) & 1u) != 0);
  EXPECT_EQ(report.outcome, IkOutcome::kLimited);
}

// The arm angle: joints turn, the tip stays.
TEST(SerialServoIk, AWishMovesTheJointsAndNotTheTip) {
  const RobotParams robot = micro::table();
  const JointVector start = micro::radians(micro::kBent_deg);
  const Pose tip = tip_at(robot, start);
  JointVector joint = start, wish{};
  wish[0] = 0.01 * kDegree;
  for (std::int32_t tick = 0; tick < 1000; ++tick) {
    const IkResult report = servo_ik(robot, tip, wish, joint);
    ASSERT_LE(report.position_error_m, 1e-6);
    ASSERT_LE(report.attitude_error_rad, 1e-6);
  }
  EXPECT_GT(joint[0] - start[0], 0.5 * kDegree);
}

TEST(SerialServoIk, SaysThatAGoalBeyondTheArmIsUnreachable) {
  const RobotParams robot = micro::table();
  JointVector joint = micro::radians(micro::kBent_deg);
  EXPECT_EQ(ticks(robot, {{6.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 10, joint).outcome, IkOutcome::kUnreachable);
}

// Stretched towards a goal just out of reach, the joints settle instead of jumping to and fro.
TEST(SerialServoIk, SettlesWhenTheGoalIsJustOutOfReach) {
  const RobotParams robot = micro::table();
  JointVector joint = micro::radians({5.0, -3.0, 4.0, -8.0, 6.0, 5.0, 2.0});
  Pose goal = tip_at(robot, {});
  goal.position_m[0] += 0.8;
  for (std::int32_t tick = 0; tick < 4000; ++tick) {
    const JointVector before = joint;
    servo_ik(robot, goal, {}, joint);
    if (tick > 2000) {
      ASSERT_LE(micro::largest_difference(joint, before), 1e-4) << tick;
    }
  }
}

TEST(SerialServoIk, TheSameInputGivesTheSameBits) {
  const RobotParams robot = micro::table();
  Random random(5);
  const Pose goal = tip_at(robot, micro::random_joints(robot, random));
  JointVector a = micro::random_joints(robot, random), b = a;
  ticks(robot, goal, 30, a);
  ticks(robot, goal, 30, b);
  EXPECT_EQ(a, b);
}

}  // namespace
}  // namespace liana::serial
