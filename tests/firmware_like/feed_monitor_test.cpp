// What is watched of the drives of a base that feeds: each limit at its value and one step beside it, of slide and
// roll, on both sides.
#include "firmware_like/cable/arm/feed_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware_like/ideal_drives.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

// The published arm on a slide and a roll, with weight: a carriage of 2 kg, and gravity along all axes.
RobotParams on_base() {
  const RobotParams fixed = zhu2022::table();
  RobotParams table = fixed;
  table.segment_count = fixed.segment_count + 1;
  table.segment[0] = SegmentParams{};
  table.segment[0].cables = 2;
  table.segment[0].theta_limit_rad = 90.0 * kDegree;
  table.segment[0].slide_m_rad = 0.3;
  table.segment[0].roll_radius_m = 0.05;
  table.segment[0].module_mass_kg = 2.0;
  for (std::size_t m = 0; m < as_index(fixed.segment_count); ++m) table.segment[m + 1] = fixed.segment[m];
  for (std::size_t i = 15; i < 17; ++i) table.drive[i] = fixed.drive[0];
  table.gravity_m_s2 = {0.2, -0.1, -0.3};
  return table;
}

constexpr WatchScope kPrepared{true, true}, kPowered{true, false}, kOff{false, false};

// Faults after `ticks` equal readings.
FaultList watched(const RobotParams& table, WatchScope scope, const FeedReading& now, double load_Nm,
                  std::int32_t drive, std::int32_t ticks) {
  TensionMonitorState state;
  FaultList faults;
  for (std::int32_t i = 0; i < ticks; ++i) {
    Watch out(static_cast<std::uint64_t>(i), faults);
    watch_feed(table, scope, now, load_Nm, drive, state, out);
  }
  return faults;
}

TEST(FeedMonitor, WhatHoldsAnAxisIsItsLoadOverItsLever) {
  const RobotParams table = on_base();
  EXPECT_DOUBLE_EQ(carriage_load_Nm(table, 0), -0.3 * 2.0 * 0.2);
  EXPECT_EQ(carriage_load_Nm(table, 1), 0.0);
  EXPECT_DOUBLE_EQ(feed_force_N(table, 0, 1.5), (-1.5 + 0.12) / 0.3);
  EXPECT_DOUBLE_EQ(feed_force_N(table, 1, 1.5), -1.5 / 0.05);
}

TEST(FeedMonitor, AForceBeyondWhatMotionAndLoadExplainIsNamedAfterFiveTicks) {
  const RobotParams table = on_base();
  const double hair_N = 1e-6;
  struct Row {
    const char* why;
    WatchScope scope;
    double beside;  // of what may be unexplained, and hairs beyond
    std::int32_t hairs, ticks;
    bool named;
  };
  const Row rows[] = {
      {"exactly explained", kPrepared, 0.0, 0, 100, false},
      {"a hair within, pulling", kPrepared, 1.0, -1, 100, false},
      {"a hair within, pushing", kPrepared, -1.0, 1, 100, false},
      {"a hair beyond, pulling, long enough", kPrepared, 1.0, 1, kFeedDebounceTicks, true},
      {"a hair beyond, pushing, long enough", kPrepared, -1.0, -1, kFeedDebounceTicks, true},
      {"beyond, a tick too short", kPrepared, 1.0, 1, kFeedDebounceTicks - 1, false},
      {"not prepared: load is unknown", kPowered, 2.0, 0, 100, false},
      {"brakes carry what they carry", kOff, 2.0, 0, 100, false},
  };
  for (const std::int32_t drive : {0, 1}) {
    for (const Row& row : rows) {
      constexpr double kLoad_Nm = 0.7;
      const double beside_N = row.beside * feed_unexplained_N(table, drive) + row.hairs * hair_N;
      const FeedReading now{feed_force_N(table, drive, kLoad_Nm) + beside_N, false};
      const FaultList faults = watched(table, row.scope, now, kLoad_Nm, drive, row.ticks);
      ASSERT_EQ(faults.count, row.named ? 1 : 0) << row.why << ", drive " << drive;
      if (!row.named) continue;
      EXPECT_EQ(faults.fault[0].number, FaultNumber::kBodyContact) << row.why;
      EXPECT_EQ(faults.fault[0].index, drive);
      const double lever_m = drive == 0 ? 0.3 : 0.05;
      EXPECT_NEAR(faults.fault[0].detail, 100.0 * lever_m * std::fabs(beside_N), 1.0) << row.why;
      EXPECT_EQ(faults.category, StopCategory::kHold);
    }
  }
}

TEST(FeedMonitor, OneTickWithoutCauseBeginsTheCountAnew) {
  RobotParams table = on_base();
  table.tension.hard_limit_N = 1e9;
  for (const std::int32_t drive : {0, 1}) {
    TensionMonitorState state;
    FaultList faults;
    for (std::int32_t i = 0; i < 3 * kFeedDebounceTicks; ++i) {
      Watch out(static_cast<std::uint64_t>(i), faults);
      const double beside_N = i % kFeedDebounceTicks == 0 ? 0.0 : 2.0 * feed_unexplained_N(table, drive);
      watch_feed(table, kPrepared, {feed_force_N(table, drive, 0.0) + beside_N, false}, 0.0, drive, state, out);
    }
    EXPECT_EQ(faults.count, 0) << drive;
  }
}

TEST(FeedMonitor, WhatMayBeUnexplainedIsFrictionAPushAtTheTipAndATenthOfTheWeight) {
  RobotParams table = on_base();
  table.tool.mass_kg = 0.5;
  double arm_kg = 0.5, reach_m = 0.0;
  for (std::size_t j = 1; j < 6; ++j) {
    arm_kg += table.segment[j].modules * table.segment[j].module_mass_kg;
    reach_m += table.segment[j].modules * table.segment[j].module_length_m;
  }
  const double g_m_s2 = std::sqrt(0.04 + 0.01 + 0.09), rated_N = 1000.0 * table.drive[0].newtons_per_permille;
  EXPECT_NEAR(feed_unexplained_N(table, 0), 0.05 * rated_N + 3.0 + 0.1 * (arm_kg + 2.0) * g_m_s2, 1e-9);
  EXPECT_NEAR(feed_unexplained_N(table, 1), 0.05 * rated_N + (3.0 + 0.1 * arm_kg * g_m_s2) * reach_m / 0.05, 1e-9);
}

TEST(FeedMonitor, AForceOverTheHardLimitTakesThePowerOffOnEitherSide) {
  const RobotParams table = on_base();
  for (const std::int32_t drive : {0, 1}) {
    for (const double side : {1.0, -1.0}) {
      const double limit_N = table.tension.hard_limit_N;
      const FaultList at = watched(table, kPowered, {side * limit_N, false}, 0.0, drive, 100);
      EXPECT_EQ(at.count, 0) << side;
      const FeedReading beyond{side * (limit_N + 1e-9), false};
      EXPECT_EQ(watched(table, kPowered, beyond, 0.0, drive, kOverloadDebounceTicks - 1).count, 0) << side;
      EXPECT_EQ(watched(table, kOff, beyond, 0.0, drive, 100).count, 0) << side;
      const FaultList faults = watched(table, kPowered, beyond, 0.0, drive, kOverloadDebounceTicks);
      ASSERT_EQ(faults.count, 1) << side;
      EXPECT_EQ(faults.fault[0].number, FaultNumber::kCableOverload);
      EXPECT_EQ(faults.fault[0].index, drive);
    }
  }
}

TEST(FeedMonitor, ADriveThatReportsNoTorqueIsWatchedByItsEncoderAlone) {
  for (const std::int32_t drive : {0, 1}) {
    RobotParams table = on_base();
    table.tension.hard_limit_N = 1e9;
    table.no_torque = 1u << as_index(drive);
    EXPECT_EQ(watched(table, kPrepared, {1e5, false}, 0.0, drive, 100).count, 0) << drive;
    EXPECT_EQ(watched(table, kPrepared, {1e5, false}, 0.0, 1 - drive, 100).count, 1) << drive;
    EXPECT_EQ(watched(table, kPrepared, {0.0, true}, 0.0, drive, 1).fault[0].number, FaultNumber::kJointJump);
  }
}

// Where the drives have stood, and what they say now.
FeedReadings read_after(const RobotParams& table, std::int32_t drive, std::int32_t counts, bool heard) {
  const CableVector zero_m{1.0, 2.0};
  CableVector before_m = zero_m;
  DriveFeedbacks drives{};
  for (std::size_t i = 0; i < 2; ++i) drives[i].position_counts = table.drive[i].zero_counts;
  drives[as_index(drive)].position_counts += counts;
  return read_feed(table, drives, zero_m, before_m, heard);
}

TEST(FeedMonitor, AnEncoderThatMovesFasterThanThreeTimesTheAxisHasJumped) {
  RobotParams table = on_base();
  table.servo_time_constant_s = 0.03;  // which the twin's drives make up for at once
  for (const std::int32_t drive : {0, 1}) {
    const double lever_m = drive == 0 ? 0.3 : 0.05;
    const double most_m = 2e-4 + lever_m * table.limits.theta_rate_rad_s * (3.0 * table.tick_s * 3.0 + 1.25 * 0.03);
    const auto most = static_cast<std::int32_t>(most_m / table.drive[as_index(drive)].metres_per_count);
    for (const std::int32_t side : {1, -1}) {
      EXPECT_FALSE(read_after(table, drive, side * most, true)[as_index(drive)].jumped) << drive;
      EXPECT_TRUE(read_after(table, drive, side * (most + 1), true)[as_index(drive)].jumped) << drive;
      EXPECT_FALSE(read_after(table, drive, side * (most + 1), true)[as_index(1 - drive)].jumped) << drive;
      EXPECT_FALSE(read_after(table, drive, side * (most + 1), false)[as_index(drive)].jumped)
          << "what was never read has not jumped";
    }
  }
}

class FeedRig : public testing::Test {
 protected:
  FeedRig() : rig_(on_base(), ThetaVector{}) {
    // What load the base has at rest: the roll's is 0 in the zero pose, the slide's drive pulls for all.
    double mass_kg = 0.0;
    for (std::size_t j = 1; j < 6; ++j) mass_kg += rig_.robot.segment[j].modules * rig_.robot.segment[j].module_mass_kg;
    EXPECT_LT(feed_force_N(rig_.robot, 0, -0.3 * 0.2 * mass_kg), feed_unexplained_N(rig_.robot, 0));
  }
  // One tick in which drive `drive` says so much more than it would.
  const Outputs& tick(std::int32_t drive, std::int32_t counts, std::int32_t permille,
                      Request request = Request::kNone) {
    Inputs inputs = rig_.drives.inputs(rig_.now++);
    inputs.drive[as_index(drive)].position_counts += counts;
    inputs.drive[as_index(drive)].torque_permille = narrow<std::int16_t>(permille);
    inputs.request = request;
    rig_.out = rig_.controller.tick(inputs);
    rig_.drives.act(rig_.out);
    return rig_.out;
  }
  Rig rig_;
};

TEST_F(FeedRig, AJumpOfSlideOrRollStopsAtOnceAndIsNamed) {
  for (const std::int32_t drive : {0, 1}) {
    Rig rig(on_base(), ThetaVector{});
    rig_ = rig;
    rig_.enable();
    const Outputs& out = tick(drive, 5000, 0);
    ASSERT_TRUE(has_fault(out, FaultNumber::kJointJump)) << drive;
    EXPECT_EQ(out.faults.fault[0].index, drive);
    EXPECT_EQ(out.faults.immediate, 1);
  }
}

TEST_F(FeedRig, AnObstacleHoldsTheArmAndLetsItBeLedBack) {
  for (const std::int32_t drive : {0, 1}) {
    Rig rig(on_base(), ThetaVector{});
    rig_ = rig;
    rig_.enable();
    const double force_N =
        feed_unexplained_N(rig_.robot, drive) + 10.0 + std::fabs(feed_force_N(rig_.robot, drive, 0.5));
    const auto permille =
        static_cast<std::int32_t>(force_N / rig_.robot.drive[as_index(drive)].newtons_per_permille) + 1;
    for (std::int32_t i = 0; i + 1 < kFeedDebounceTicks; ++i) EXPECT_EQ(tick(drive, 0, permille).faults.count, 0);
    const Outputs& out = tick(drive, 0, permille);
    ASSERT_EQ(out.faults.count, 1) << drive;
    EXPECT_EQ(out.faults.fault[0].number, FaultNumber::kBodyContact);
    EXPECT_EQ(out.faults.fault[0].index, drive);
    EXPECT_EQ(out.state, OperatingState::kEnabled);
    EXPECT_TRUE(allow_retract(out.faults));
  }
}

// Property: whatever the pose, gravity and payload, drives that carry what the arm weighs are never named, and drives
// that carry more than may be unexplained always are.
TEST(FeedMonitor, OfSeededArmsNoneIsNamedForItsWeightAndEveryOneForMore) {
  Random random(3607);
  for (int n = 0; n < 300; ++n) {
    RobotParams table = on_base();
    table.gravity_m_s2 = random.vector(9.80665);
    table.tool.mass_kg = random.uniform(0.0, 2.0);
    table.segment[0].module_mass_kg = random.uniform(0.0, 5.0);
    ThetaVector theta_rad = random.theta(table, 15.0);
    theta_rad[0] = random.uniform(-1.5, 1.5), theta_rad[1] = random.uniform(-1.5, 1.5);
    const ArmTrig trig = arm_trig(table, theta_rad);
    const ThetaVector load_Nm = static_load_Nm(table, theta_rad, trig, forward_kinematics(table, trig));
    for (const std::int32_t drive : {0, 1}) {
      const double force_N = feed_force_N(table, drive, load_Nm[as_index(drive)]);
      if (drive == 0) {
        double mass_kg = table.tool.mass_kg + table.segment[0].module_mass_kg;
        for (std::size_t j = 1; j < 6; ++j) mass_kg += table.segment[j].modules * table.segment[j].module_mass_kg;
        ASSERT_NEAR(force_N, mass_kg * table.gravity_m_s2[0], 1e-9) << n;
      }
      const double share = random.uniform(-0.999, 0.999), unexplained_N = feed_unexplained_N(table, drive);
      const double over = (share < 0.0 ? -1.0 : 1.0) * random.uniform(1.001, 3.0);
      table.tension.hard_limit_N = 1e9;
      const double load = load_Nm[as_index(drive)];
      ASSERT_EQ(watched(table, kPrepared, {force_N + share * unexplained_N, false}, load, drive, 100).count, 0) << n;
      ASSERT_EQ(watched(table, kPrepared, {force_N + over * unexplained_N, false}, load, drive, 100).count, 1) << n;
    }
  }
}

}  // namespace
}  // namespace liana::cable
