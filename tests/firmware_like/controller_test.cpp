// The whole core behind its one door, on ideal drives.
#include "firmware_like/cable_controller.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "tests/firmware_like/ideal_drives.hpp"

namespace liana::cable {
namespace {

TEST(Controller, HomesFromTheStoredZerosWithoutMoving) {
  Rig rig;
  const auto before = rig.drives.inputs(0).drive;
  rig.run(100);
  EXPECT_TRUE(rig.out.homed);
  EXPECT_EQ(rig.out.state, OperatingState::kDisabled);
  EXPECT_LE(zhu2022::largest_difference(rig.out.theta_measured_rad, zhu2022::radians(zhu2022::kPrepare_deg)),
            0.01 * kDegree);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c)
    EXPECT_EQ(rig.drives.inputs(0).drive[c].position_counts, before[c].position_counts);
}

TEST(Controller, ALengthThatContradictsTheOthersIsNotHomed) {
  Rig rig;
  for (std::int32_t i = 0; i < 200; ++i) {
    Inputs inputs = rig.drives.inputs(rig.now++);
    inputs.drive[4].position_counts += 7000;  // 10 mm
    rig.out = rig.controller.tick(inputs);
  }
  EXPECT_FALSE(rig.out.homed);
}

TEST(Controller, EnablingIsBumpless) {
  Rig rig;
  rig.run(60);
  const double step_counts =
      rig.robot.limits.cable_speed_m_s * rig.robot.tick_s * kTargetSpeedMargin / rig.robot.drive[0].metres_per_count +
      1.0;
  const ThetaVector before = rig.out.theta_measured_rad;
  rig.tick(Request::kEnable);
  for (std::int32_t i = 0; i < 1200; ++i) {
    const auto actual = rig.drives.inputs(0).drive;
    rig.tick();
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      ASSERT_LE(std::abs(rig.out.drive[c].target_counts - actual[c].position_counts), step_counts) << i << " " << c;
    }
    ASSERT_LE(zhu2022::largest_difference(rig.out.theta_measured_rad, before), 0.1 * kDegree) << i;
  }
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
  EXPECT_EQ(rig.out.faults.count, 0);
}

// The arm is held while the cables are loose at first: pretension comes as a ramp over seconds, not at the cables' top
// speed.
TEST(Controller, PretensionComesAsARamp) {
  Rig rig;
  rig.robot.friction_mu = 0.0;
  const CableLayout layout = cable_layout(rig.robot);
  const ThetaVector pose = zhu2022::radians(zhu2022::kPrepare_deg);
  const CableGeometry geometry = cable_geometry(rig.robot, layout, arm_trig(rig.robot, pose));
  Inputs inputs = rig.drives.inputs(0);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c)
    inputs.drive[c].position_counts += rig.robot.drive[c].direction * 300;  // 0.43 mm loose
  std::int32_t max_counts = 0;
  for (std::int32_t i = 0; i < 1300; ++i) {
    inputs.tick = rig.now++;
    inputs.request = i == 60 ? Request::kEnable : Request::kNone;
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      const double zero_m = layout.zero_length_m[c] + rig.robot.lead_m;
      const double payout_m = payout_at_counts(rig.robot.drive[c], zero_m, inputs.drive[c].position_counts);
      const double pulled_N = rig.robot.cable_EA_N * (geometry.length_m[c] + rig.robot.lead_m - payout_m) / payout_m;
      inputs.drive[c].torque_permille =
          narrow<std::int16_t>(to_counts(pulled_N / rig.robot.drive[c].newtons_per_permille).value);
    }
    rig.out = rig.controller.tick(inputs);
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      DriveFeedback& drive = inputs.drive[c];
      drive.statusword = IdealDrives::answer_to(rig.out.drive[c].controlword, drive.statusword);
      max_counts = std::max(max_counts, std::abs(rig.out.drive[c].target_counts - drive.position_counts));
      drive.position_counts = rig.out.drive[c].target_counts;
    }
  }
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
  EXPECT_LE(max_counts, 10);  // 3 mm/s, loose cables wound in as well; the cables' top speed is 28 counts a tick
}

// req:A11 req:A17
TEST(Controller, FollowsATipTelecommandWithTheMeasuredArm) {
  Rig rig;
  rig.enable();
  const Setpoint setpoint = rig.tip_by({0.05, 0.03, -0.04});
  rig.tick(Request::kNone, rig.release(setpoint));
  EXPECT_EQ(rig.out.active_sequence, 1u);
  rig.run(4000);
  EXPECT_LE(norm(subtract(rig.out.tip_command.position_m, setpoint.tip_in_base.position_m)), 1e-3);
  EXPECT_LE(norm(subtract(tip_pose(rig.robot, arm_trig(rig.robot, rig.out.theta_measured_rad)).position_m,
                          setpoint.tip_in_base.position_m)),
            3e-3);
  EXPECT_EQ(rig.out.faults.count, 0);
}

TEST(Controller, FollowsAJointTelecommandExactly) {
  Rig rig;
  // These drives' arm has no mass: one that is told of mass looks pushed when it turns at once.
  for (SegmentParams& segment : rig.robot.segment) segment.module_mass_kg = 0.0;
  rig.controller = decltype(rig.controller)(rig.robot);
  rig.enable();
  const ThetaVector goal = zhu2022::plus(rig.out.theta_command_rad, zhu2022::Random(1).theta(rig.robot, 1.0));
  rig.tick(Request::kNone, rig.release(rig.joints(goal)));
  rig.run(3000);
  EXPECT_EQ(rig.out.theta_command_rad, goal);
  EXPECT_LE(zhu2022::largest_difference(rig.out.theta_measured_rad, goal), 0.02 * kDegree);
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_EQ(rig.out.faults.count, 0);
}

TEST(Controller, ExpiryBrakesAndHoldsEnabled) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.5, 0.0, 0.0}), 300));
  rig.run(299);
  EXPECT_FALSE(rig.out.at_rest);
  EXPECT_EQ(rig.out.limits & kLimitExpired, 0u);
  rig.tick();
  EXPECT_TRUE(rig.out.limits & kLimitExpired);
  EXPECT_EQ(rig.out.active_sequence, 0u);
  rig.run(1000);
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
  const ThetaVector stood = rig.out.theta_command_rad;
  rig.run(200);
  EXPECT_LE(zhu2022::largest_difference(rig.out.theta_command_rad, stood), 1e-7);
}

TEST(Controller, ATelecommandThatIsNotANumberIsFault1001AndNeverFollowed) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Rig rig;
    rig.enable();
    const ThetaVector before = rig.out.theta_command_rad;
    Setpoint setpoint = rig.tip_by({bad, 0.0, 0.0});
    rig.tick(Request::kNone, rig.release(setpoint));
    EXPECT_TRUE(has_fault(rig.out, FaultNumber::kCommandInvalid));
    EXPECT_EQ(rig.out.active_sequence, 0u);
    rig.run(300);
    EXPECT_LE(zhu2022::largest_difference(rig.out.theta_command_rad, before), 1e-9);
    for (double number : numbers(rig.out)) ASSERT_TRUE(std::isfinite(number));
  }
  Rig rig;
  rig.enable();
  ThetaVector beyond{};
  beyond[2] = 21.0 * kDegree;
  rig.tick(Request::kNone, rig.release(rig.joints(beyond)));
  EXPECT_TRUE(has_fault(rig.out, FaultNumber::kCommandInvalid));
}

TEST(Controller, AnOldSequenceIsIgnored) {
  Rig rig;
  rig.enable();
  const ThetaVector stay = rig.out.theta_command_rad;
  rig.tick(Request::kNone, Release::make(10, rig.now, kForever, 1, rig.joints(stay)));
  for (const std::uint64_t old : {std::uint64_t{9}, std::uint64_t{10}}) {
    rig.tick(Request::kNone, Release::make(old, rig.now, kForever, 1, rig.joints(ThetaVector{})));
    rig.run(100);
    EXPECT_EQ(rig.out.active_sequence, 10u);
    EXPECT_EQ(rig.out.theta_command_rad, stay);
  }
}

TEST(Controller, ATelecommandWaitsForItsFirstTick) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, Release::make(1, rig.now + 50, kForever, 1, rig.joints(ThetaVector{})));
  rig.run(49);
  EXPECT_EQ(rig.out.active_sequence, 0u);
  rig.tick();
  EXPECT_EQ(rig.out.active_sequence, 1u);
}

// The twin: a copy goes on bit by bit as the original does; and two controllers with the same inputs never differ.
// req:C1
TEST(Controller, ACopyInMotionContinuesBitIdentically) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.05, 0.05, 0.0})));
  rig.run(200);
  Rig twin = rig;
  for (std::int32_t i = 0; i < 1000; ++i) {
    const Telecommand next = i == 300 ? rig.release(rig.tip_by({-0.1, 0.0, 0.1})) : Telecommand{};
    rig.tick(Request::kNone, next);
    twin.tick(Request::kNone, next);
    ASSERT_EQ(numbers(rig.out), numbers(twin.out)) << i;
  }
}

TEST(Controller, TheSameInputsGiveTheSameOutputsFromTheFirstTick) {
  Rig first, second;
  for (std::int32_t i = 0; i < 1500; ++i) {
    const Request request = i == 60 ? Request::kEnable : Request::kNone;
    ASSERT_EQ(numbers(first.tick(request)), numbers(second.tick(request))) << i;
  }
  EXPECT_EQ(first.out.state, OperatingState::kEnabled);
}

TEST(Controller, ADriveSilentForThreeTicksIsAFaultAndStopsAllDrives) {
  Rig rig;
  rig.enable();
  for (std::int32_t age = 1; age <= 2; ++age) {
    rig.drives.silence(7);
    rig.tick();
    EXPECT_EQ(rig.out.faults.count, 0) << age;
  }
  rig.drives.silence(7);
  rig.tick();
  ASSERT_TRUE(has_fault(rig.out, FaultNumber::kDriveSilent));
  EXPECT_EQ(rig.out.faults.fault[0].index, 7);
  EXPECT_EQ(rig.out.stop_category, StopCategory::kStop);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) EXPECT_NE(rig.out.drive[c].controlword, kEnableOperation) << c;
  rig.run(500);
  EXPECT_EQ(rig.out.state, OperatingState::kFault);
}

TEST(Controller, AStopWhileMovingEndsAlongThePathWithoutAQuickStop) {
  Rig rig;
  rig.enable();
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.5, 0.0, 0.0})));
  rig.run(400);
  rig.tick(Request::kStop);
  bool quick_stop = false;
  for (std::int32_t i = 0; i < 1500 && rig.out.state == OperatingState::kStopping; ++i) {
    rig.tick();
    for (std::size_t c = 0; c < zhu2022::kCables; ++c)
      quick_stop = quick_stop || rig.out.drive[c].controlword == kQuickStopCommand;
  }
  EXPECT_EQ(rig.out.state, OperatingState::kDisabled);
  EXPECT_FALSE(quick_stop);
  EXPECT_EQ(rig.out.faults.count, 0);
}

TEST(Controller, AHoldTelecommandEndsTheMotionOnItsWayAndKeepsTheArmEnabled) {
  Rig rig;
  rig.enable();
  const ThetaVector goal = zhu2022::plus(rig.out.theta_command_rad, zhu2022::Random(1).theta(rig.robot, 2.0));
  rig.tick(Request::kNone, rig.release(rig.joints(goal)));
  rig.run(150);
  ASSERT_FALSE(rig.out.at_rest);
  Setpoint hold;
  hold.kind = CommandKind::kHold;
  rig.tick(Request::kNone, rig.release(hold));
  rig.run(500);  // from 0.9 deg/s, as gently as the room for acceleration asks
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
  EXPECT_GT(zhu2022::largest_difference(rig.out.theta_command_rad, goal), 0.2 * kDegree) << "it went on to its goal";
  const ThetaVector stood = rig.out.theta_command_rad;
  rig.run(400);
  EXPECT_EQ(rig.out.theta_command_rad, stood);
}

TEST(Controller, HeldAnglesOutOfTheirLimitsAreFault1001AndNeverFollowed) {
  for (const std::size_t theta : {std::size_t{0}, std::size_t{8}, std::size_t{9}}) {
    for (const double side : {1.0, -1.0}) {
      Rig rig;
      rig.enable();
      Setpoint setpoint = rig.tip_by({0.01, 0.0, 0.0});
      const double limit_rad = rig.robot.segment[theta / 2].theta_limit_rad;
      setpoint.held_mask = 1u << theta;
      setpoint.held_rad[theta] = side * limit_rad;
      EXPECT_TRUE(is_usable(rig.robot, setpoint)) << "the limit itself";
      setpoint.held_rad[theta] = side * (limit_rad + 1e-6);
      EXPECT_FALSE(is_usable(rig.robot, setpoint));
      rig.tick(Request::kNone, rig.release(setpoint));
      EXPECT_TRUE(has_fault(rig.out, FaultNumber::kCommandInvalid)) << theta;
    }
  }
}

// The last limit before the drives: cables never wind faster than the table says, whatever tension is planned.
TEST(Controller, DrumsNeverTurnFasterThanTheTablesCableSpeed) {
  RobotParams robot = zhu2022::table();
  robot.limits.cable_speed_m_s = 1e-4;
  const ThetaVector pose = zhu2022::radians(zhu2022::kPrepare_deg);
  Controller controller(robot);
  const IdealDrives ideal(robot, pose);
  Inputs inputs = ideal.inputs(0);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c)
    inputs.drive[c].position_counts += robot.drive[c].direction * 300;  // 0.43 mm loose: the ramp draws them in
  constexpr std::int32_t kWindow = 100;
  const double allowed = kWindow * robot.limits.cable_speed_m_s * robot.tick_s / robot.drive[0].metres_per_count + 2.0;
  std::vector<DriveCommands> sent;
  double most = 0.0;
  for (std::int32_t i = 0; i < 1300; ++i) {
    inputs.tick = static_cast<std::uint64_t>(i) + 1;
    inputs.request = i == 60 ? Request::kEnable : Request::kNone;
    const Outputs out = controller.tick(inputs);
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      inputs.drive[c].statusword = IdealDrives::answer_to(out.drive[c].controlword, inputs.drive[c].statusword);
      inputs.drive[c].position_counts = out.drive[c].target_counts;
      if (i < 200 + kWindow) continue;
      const std::int32_t then = sent[static_cast<std::size_t>(i - kWindow)][c].target_counts;
      const double turned = std::abs(out.drive[c].target_counts - then);
      ASSERT_LE(turned, allowed) << i << " " << c;
      most = std::max(most, turned);
    }
    sent.push_back(out.drive);
  }
  EXPECT_GT(most, 0.9 * (allowed - 2.0)) << "the limit has to act";
}

}  // namespace
}  // namespace liana::cable
