// Goal IK of the serial arm.
#include "host/model/inverse_kinematics/serial_goal_ik.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/micro_arm.hpp"
#include "tests/rounds.hpp"

namespace liana::inverse_kinematics {
namespace {

using serial::forward_kinematics;
using serial::JointVector;
using serial::RobotParams;
using serial::micro::Random;
namespace micro = serial::micro;

double error_of(const RobotParams& robot, const Pose& goal, const JointVector& joint) {
  const Pose tip = forward_kinematics(robot, joint).tip_in_base;
  return norm(subtract(goal.position_m, tip.position_m)) +
         norm(rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion))));
}

TEST(SerialGoalIk, ReachesAtLeast999Of1000PosesFromAnywhere) {
  const RobotParams robot = micro::table();
  Random random(1);
  std::int32_t reached = 0;
  for (std::int32_t i = 0; i < rounds(2000); ++i) {
    const Pose goal = forward_kinematics(robot, micro::random_joints(robot, random)).tip_in_base;
    const SerialGoalResult result = solve_goal(robot, {goal, micro::random_joints(robot, random)});
    ASSERT_TRUE(micro::within_ranges(robot, result.joint_rad));
    ASSERT_EQ(result.converged, error_of(robot, goal, result.joint_rad) < 2e-6) << i;
    if (result.converged) ++reached;
  }
  EXPECT_GE(reached, rounds(2000) - rounds(2000) / 1000);
}

// The arm is where it should be, or nearly: no other elbow is worth the way.
// req:C5
TEST(SerialGoalIk, AGoalNearbyIsReachedWithASmallMove) {
  const RobotParams robot = micro::table();
  Random random(2);
  std::int32_t small = 0;
  for (std::int32_t i = 0; i < 300; ++i) {
    const JointVector from = micro::random_joints(robot, random, 0.9);
    const Pose goal = forward_kinematics(robot, micro::near(robot, from, random, 2.0 * kDegree)).tip_in_base;
    if (solve_goal(robot, {goal, from}).move_s < 10.0) ++small;
  }
  EXPECT_GE(small, 285);  // the rest are near singular poses, where small moves of the tip need large ones of joints
}

// A joint that may turn one and a half times round meets most angles twice: the nearer one is taken.
// req:C5
TEST(SerialGoalIk, NoJointOfASolutionIsNearerByAWholeTurn) {
  const RobotParams robot = micro::table();
  Random random(4);
  for (std::int32_t i = 0; i < 300; ++i) {
    const JointVector from = micro::random_joints(robot, random);
    const Pose goal = forward_kinematics(robot, micro::random_joints(robot, random)).tip_in_base;
    const JointVector joint = solve_goal(robot, {goal, from}).joint_rad;
    for (std::size_t k = 0; k < robot.joints(); ++k) {
      for (const double turned : {joint[k] - 2.0 * kPi, joint[k] + 2.0 * kPi}) {
        const bool allowed = turned >= robot.joint[k].low_rad && turned <= robot.joint[k].high_rad;
        ASSERT_FALSE(allowed && std::fabs(turned - from[k]) < std::fabs(joint[k] - from[k])) << i << " joint " << k;
      }
    }
  }
}

TEST(SerialGoalIk, SaysWhenThereIsNoSolutionAndHowFarAwayTheBestIs) {
  const RobotParams robot = micro::table();
  const SerialGoalResult result = solve_goal(robot, {{{5.5, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, {}});
  EXPECT_FALSE(result.converged);
  EXPECT_GT(result.position_error_m + result.attitude_error_rad, 0.5);
}

TEST(SerialGoalIk, TheSameInputGivesTheSameResult) {
  const RobotParams robot = micro::table();
  Random random(3);
  const SerialGoal goal{forward_kinematics(robot, micro::random_joints(robot, random)).tip_in_base,
                        micro::random_joints(robot, random)};
  const SerialGoalResult a = solve_goal(robot, goal), b = solve_goal(robot, goal);
  EXPECT_EQ(a.joint_rad, b.joint_rad);
  EXPECT_EQ(a.iterations, b.iterations);
}

}  // namespace
}  // namespace liana::inverse_kinematics
