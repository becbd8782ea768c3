// The whole core with a serial arm, behind its one door, on ideal drives.
#include "firmware_like/serial_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/firmware_like/serial_rig.hpp"

namespace liana::serial {
namespace {

using micro::has_fault;
using micro::Rig;

JointVector moved(const JointVector& joint_rad, double by_rad) {
  JointVector out = joint_rad;
  for (std::size_t i = 0; i < micro::kJoints; ++i) out[i] += i % 2 == 0 ? by_rad : -by_rad;
  return out;
}

TEST(SerialController, HomesFromAbsoluteEncodersWithoutMoving) {
  Rig rig;
  const DriveFeedbacks before = rig.drive;
  rig.run(static_cast<std::int32_t>(kHomingTicks) - 1);
  EXPECT_FALSE(rig.out.homed);
  rig.run(10);
  EXPECT_TRUE(rig.out.homed);
  EXPECT_EQ(rig.out.state, OperatingState::kDisabled);
  EXPECT_LE(micro::largest_difference(rig.out.joint_measured_rad, micro::radians(micro::kBent_deg)), 1e-5);
  for (std::size_t i = 0; i < micro::kJoints; ++i) EXPECT_EQ(rig.drive[i].position_counts, before[i].position_counts);
}

TEST(SerialController, AnEncoderOutsideTheJointsRangeIsNotHomedAndKeepsTheArmDisabled) {
  JointVector joint = micro::radians(micro::kBent_deg);
  joint[3] = (micro::kRange_deg + 1.5) * kDegree;
  Rig rig(joint);
  rig.run(100);
  EXPECT_FALSE(rig.out.homed);
  rig.tick(Request::kEnable);
  rig.run(200);
  EXPECT_EQ(rig.out.state, OperatingState::kDisabled);
}

// req:C2
TEST(SerialController, ASilentDriveAtTheStartIsNotHomed) {
  Rig rig;
  for (std::int32_t i = 0; i < 200; ++i) {
    rig.drive[5].feedback_age_ticks = 0xFFFF;
    rig.tick();
  }
  EXPECT_FALSE(rig.out.homed);
}

TEST(SerialController, EnablingIsBumpless) {
  Rig rig;
  rig.run(60);
  const DriveFeedbacks before = rig.drive;
  rig.tick(Request::kEnable);
  for (std::int32_t tick = 0; tick < 300; ++tick) {
    rig.tick();
    for (std::size_t i = 0; i < micro::kJoints; ++i)
      ASSERT_EQ(rig.out.drive[i].target_counts, before[i].position_counts) << tick;
  }
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
}

TEST(SerialController, FollowsAJointTelecommand) {
  Rig rig;
  rig.enable();
  const JointVector goal = moved(rig.out.joint_command_rad, 3.0 * kDegree);
  rig.tick(Request::kNone, rig.release(rig.joints(goal)));
  rig.run(3000);
  EXPECT_LE(micro::largest_difference(rig.out.joint_command_rad, goal), 1e-9);
  EXPECT_LE(micro::largest_difference(rig.out.joint_measured_rad, goal), 4e-6);  // half a count and a rounding
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_EQ(rig.out.faults.count, 0);
}

TEST(SerialController, FollowsATipTelecommandWithTheMeasuredArm) {
  Rig rig;
  rig.enable();
  const Setpoint setpoint = rig.tip_by({0.15, 0.1, -0.12});
  rig.tick(Request::kNone, rig.release(setpoint));
  EXPECT_EQ(rig.out.active_sequence, 1u);
  rig.run(4000);
  const Pose tip = forward_kinematics(rig.robot, rig.out.joint_measured_rad).tip_in_base;
  EXPECT_LE(norm(subtract(tip.position_m, setpoint.tip_in_base.position_m)), 1e-4);
  EXPECT_LE(norm(rotation_vector(multiply(tip.quaternion, conjugate(setpoint.tip_in_base.quaternion)))), 2e-5);
  EXPECT_EQ(rig.out.faults.count, 0);
}

TEST(SerialController, ExpiryBrakesAndHoldsEnabled) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.8, 0.0, 0.0}), 300));
  rig.run(299);
  EXPECT_FALSE(rig.out.at_rest);
  EXPECT_EQ(rig.out.limits & kLimitExpired, 0u);
  rig.tick();
  EXPECT_TRUE((rig.out.limits & kLimitExpired) != 0);
  EXPECT_EQ(rig.out.active_sequence, 0u);
  rig.run(1000);
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
}

TEST(SerialController, HoldStopsAJointMotionOnItsPathAndStaysEnabled) {
  Rig rig;
  rig.enable();
  const JointVector start = rig.out.joint_command_rad;
  JointVector goal = start;
  goal[1] += 40.0 * kDegree;
  goal[4] -= 20.0 * kDegree;
  for (std::int32_t i = 1; i <= 100; ++i) {  // as the arbiter leads: a setpoint per interval
    JointVector way = start;
    for (std::size_t k = 0; k < micro::kJoints; ++k) way[k] += 0.0008 * i * (goal[k] - start[k]);
    rig.tick(Request::kNone, rig.release(rig.joints(way)));
    rig.run(4);
  }
  ASSERT_FALSE(rig.out.at_rest);
  rig.tick(Request::kNone, rig.release(rig.only(CommandKind::kHold)));
  rig.run(1000);
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
  const JointVector stood = rig.out.joint_command_rad;
  EXPECT_NEAR((stood[1] - start[1]) / (goal[1] - start[1]), (stood[4] - start[4]) / (goal[4] - start[4]), 2e-3);
}

TEST(SerialController, StopComesToRestThenBrakesThenDisables) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.8, 0.0, 0.0})));
  rig.run(400);
  rig.tick(Request::kNone, rig.release(rig.only(CommandKind::kStop)));
  rig.tick();
  EXPECT_EQ(rig.out.state, OperatingState::kStopping);
  bool moved_without_power = false;
  for (std::int32_t i = 0; i < 2000 && rig.out.state != OperatingState::kDisabled; ++i) {
    rig.tick();
    const bool powered = decode(rig.drive[0].statusword) == DriveState::kOperationEnabled;
    if (!powered && !rig.out.at_rest) moved_without_power = true;
  }
  EXPECT_FALSE(moved_without_power);
  EXPECT_EQ(rig.out.state, OperatingState::kDisabled);
}

TEST(SerialController, ADriveFaultStopsTheOthersInTheSameTickAndClearsOnRequest) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.8, 0.0, 0.0})));
  rig.run(400);
  rig.drive[2].statusword = 0x0218;  // fault
  rig.drive[2].emergency_code = 0x2310;
  rig.tick();
  EXPECT_TRUE(has_fault(rig.out, FaultNumber::kDriveFault));
  for (std::size_t i = 0; i < micro::kJoints; ++i) {
    if (i != 2) {
      EXPECT_EQ(rig.out.drive[i].controlword & 0x000F, kQuickStopCommand) << i;
    }
  }
  rig.run(1000);
  EXPECT_EQ(rig.out.state, OperatingState::kFault);
  rig.drive[2].statusword = 0x0250;
  rig.tick(Request::kClear);
  rig.run(300);
  EXPECT_EQ(rig.out.state, OperatingState::kDisabled);
  EXPECT_EQ(rig.out.faults.count, 0);
}

TEST(SerialController, AnEncoderThatJumpsIsAFaultInTheSameTick) {
  Rig rig;
  rig.enable();
  rig.drive[4].position_counts += to_counts(0.5 * kDegree / rig.robot.drive[4].rad_per_count).value;
  rig.tick();
  EXPECT_TRUE(has_fault(rig.out, FaultNumber::kJointJump));
  EXPECT_EQ(rig.out.stop_category, StopCategory::kStop);
}

// A joint far behind its command that the next tick shows `turned_rad` further.
bool has_jumped(const RobotParams& table, std::int32_t joint, double turned_rad) {
  const DriveParams& drive = table.drive[as_index(joint)];
  JointMonitorState state;
  DriveFeedback feedback{};
  feedback.position_counts = drive.zero_counts;
  feedback.feedback_age_ticks = 0;
  read_joint(table, feedback, joint, state);
  feedback.position_counts += to_counts(turned_rad / drive.rad_per_count).value;
  read_joint(table, feedback, joint, state);
  return state.reading[as_index(joint)].jumped;
}

TEST(SerialController, AJointMayCatchUpAsFarAsItsServoLagsAndNotACountMore) {
  RobotParams table = micro::table();
  table.servo_time_constant_s = 0.08;
  table.joint[2].rate_rad_s *= 2.0;
  const double moved_s = 3.0 * table.tick_s * 3.0;
  for (const std::int32_t joint : {2, 3}) {
    const double count_rad = table.drive[as_index(joint)].rad_per_count,
                 rate_rad_s = table.joint[as_index(joint)].rate_rad_s;
    const double lag_rad = table.servo_time_constant_s * rate_rad_s;
    EXPECT_GT(lag_rad, 5e-4 + rate_rad_s * moved_s) << "more than a joint moves in three ticks, three times as fast";
    const double max_rad = 5e-4 + rate_rad_s * moved_s + 1.25 * lag_rad;
    const double max_counts = std::floor(max_rad / count_rad);
    for (const double side : {1.0, -1.0}) {
      EXPECT_FALSE(has_jumped(table, joint, side * (lag_rad + rate_rad_s * table.tick_s))) << joint;
      EXPECT_FALSE(has_jumped(table, joint, side * max_counts * count_rad)) << joint;
      EXPECT_TRUE(has_jumped(table, joint, side * (max_counts + 1.0) * count_rad)) << joint;
    }
  }
}

TEST(SerialController, AJointOfATorqueDriveHasNoServoToLagBehind) {
  RobotParams table = micro::table();
  table.servo_time_constant_s = 0.08;
  table.torque.is_torque_controlled = 1;
  const double count_rad = table.drive[3].rad_per_count;
  const double max_counts = std::floor((5e-4 + table.joint[3].rate_rad_s * 9.0 * table.tick_s) / count_rad);
  EXPECT_FALSE(has_jumped(table, 3, max_counts * count_rad));
  EXPECT_TRUE(has_jumped(table, 3, (max_counts + 1.0) * count_rad));
}

TEST(SerialController, AJointPushedOutOfItsRangeIsAFault) {
  JointVector joint = micro::radians(micro::kBent_deg);
  joint[0] = (micro::kRange_deg + 0.9) * kDegree;
  Rig rig(joint);
  rig.enable();
  const std::int32_t step = to_counts(0.02 * kDegree / rig.robot.drive[0].rad_per_count).value;
  const std::int32_t start = rig.drive[0].position_counts;
  for (std::int32_t i = 1; i <= 10; ++i) {
    rig.drive[0].position_counts = start + i * step;
    EXPECT_FALSE(i < 5 && has_fault(rig.out, FaultNumber::kJointOutOfRange)) << i;
    rig.tick();
  }
  EXPECT_TRUE(has_fault(rig.out, FaultNumber::kJointOutOfRange));
}

TEST(SerialController, ADriveThatDoesNotFollowIsAFault) {
  Rig rig;
  rig.enable();
  const std::int32_t stuck = rig.drive[1].position_counts;
  JointVector goal = rig.out.joint_command_rad;
  goal[1] += 2.0 * kDegree;
  rig.tick(Request::kNone, rig.release(rig.joints(goal)));
  for (std::int32_t i = 0; i < 500; ++i) {
    rig.drive[1].position_counts = stuck;
    rig.tick();
  }
  EXPECT_TRUE(has_fault(rig.out, FaultNumber::kFollowingError));
}

// The gate's limits in drive units: a full-rate step passes, a faster one, one out of range and another mode do not.
TEST(SerialController, TheGateKnowsRangeRateAndModeOfEveryJoint) {
  const RobotParams robot = micro::table();
  const GateLimits limits = make_gate_limits(robot);
  DriveProposals proposals{};
  DriveCommands previous{};
  DriveFeedbacks feedback{};
  for (std::size_t i = 0; i < micro::kJoints; ++i) {
    feedback[i].statusword = 0x1237;
    feedback[i].position_counts = previous[i].target_counts = robot.drive[i].zero_counts;
    previous[i].controlword = kEnableOperation;
    proposals[i].target_counts = robot.drive[i].zero_counts;
  }
  const auto judge = [&] {
    return gate(limits, DriveGoal::kOperationEnabled, true, proposals, previous, feedback).check;
  };
  EXPECT_EQ(judge(), GateCheck::kPassed);
  const double step = robot.joint[6].rate_rad_s * robot.tick_s / robot.drive[6].rad_per_count;
  proposals[6].target_counts += step;
  EXPECT_EQ(judge(), GateCheck::kPassed);
  proposals[6].target_counts += 0.3 * step;
  EXPECT_EQ(judge(), GateCheck::kStepTooLarge);
  proposals[6].target_counts = counts_at_joint(robot.drive[6], robot.joint[6].high_rad + 0.1);
  EXPECT_EQ(judge(), GateCheck::kTargetOutOfRange);
  proposals[6].target_counts = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge(), GateCheck::kTargetNotFinite);
  proposals[6].target_counts = robot.drive[6].zero_counts;
  proposals[6].mode = DriveMode::kCyclicTorque;
  EXPECT_EQ(judge(), GateCheck::kModeNotAllowed);
}

TEST(SerialController, ATelecommandThatIsNotANumberIsFault1001AndNeverFollowed) {
  Rig rig;
  rig.enable();
  const JointVector before = rig.out.joint_command_rad;
  rig.tick(Request::kNone, rig.release(rig.tip_by({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0})));
  EXPECT_TRUE(has_fault(rig.out, FaultNumber::kCommandInvalid));
  rig.run(300);
  EXPECT_EQ(rig.out.joint_command_rad, before);
  for (const double number : micro::numbers(rig.out)) ASSERT_TRUE(std::isfinite(number));
}

// The checker is the controller: a copy ticked with the same inputs does the same, to the last bit.
TEST(SerialController, ACopyDoesTheSame) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.3, 0.1, 0.0})));
  rig.run(100);
  Rig twin = rig;
  for (std::int32_t i = 0; i < 1000; ++i) {
    ASSERT_EQ(micro::numbers(rig.tick()), micro::numbers(twin.tick())) << i;
  }
}

}  // namespace
}  // namespace liana::serial
