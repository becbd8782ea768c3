#include "firmware_like/safety/drive_link_monitor.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "tests/firmware_like/safety_bench.hpp"

namespace liana::cable {
namespace {

using namespace safety_bench;

constexpr WatchScope kUnpowered{false, false};
constexpr WatchScope kRamp{true, false};
constexpr WatchScope kRunning{true, true};

// Watchdogs fed tick by tick with drives that are healthy until a test says otherwise.
class WatchdogsOfAnArm : public ::testing::Test {
 protected:
  WatchdogsOfAnArm() {
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      sent_[i] = {0x000F, 1000000};
      tension_N_[i] = 40.0;
    }
    run(kRunning);  // every drive has been seen alive
    EXPECT_EQ(faults_.count, 0);
  }

  std::int32_t run(WatchScope scope) { return watchdogs_.run(scope, inputs_, sent_, tension_N_, lowpass_N_, faults_); }

  Watchdogs watchdogs_{};
  CycleInputs inputs_ = healthy(kStatusEnabled);
  DriveCommands sent_{};
  CableVector tension_N_{}, lowpass_N_{};
  FaultList faults_{};
};

TEST_F(WatchdogsOfAnArm, HealthyDrivesRaiseNothing) {
  for (int tick = 0; tick < 1000; ++tick) EXPECT_EQ(run(kRunning), 0);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(WatchdogsOfAnArm, ATpdoMayBeMissingForTwoTicksAndThenTheDriveIsSilent) {
  inputs_.drive[3].feedback_age_ticks = 2;
  EXPECT_EQ(run(kRunning), 0);
  inputs_.drive[3].feedback_age_ticks = 3;
  EXPECT_EQ(run(kRunning), 1);
  EXPECT_TRUE(has(faults_, FaultNumber::kDriveSilent, 3));
  EXPECT_EQ(faults_.fault[0].detail, 3);
}

TEST_F(WatchdogsOfAnArm, AHeartbeatMayBe300MillisecondsOld) {
  inputs_.drive[5].heartbeat_age_ticks = 75;
  EXPECT_EQ(run(kRunning), 0);
  inputs_.drive[5].heartbeat_age_ticks = 76;
  EXPECT_EQ(run(kRunning), 1);
  EXPECT_TRUE(has(faults_, FaultNumber::kDriveMissing, 5));
}

// One age over its bound does not make the other wrong that is at its own.
TEST_F(WatchdogsOfAnArm, AnAgeAtItsBoundIsNotBlamedForTheOther) {
  inputs_.drive[0].feedback_age_ticks = 2;
  inputs_.drive[0].heartbeat_age_ticks = 76;
  inputs_.drive[kDrives - 1].feedback_age_ticks = 3;
  inputs_.drive[kDrives - 1].heartbeat_age_ticks = 75;
  EXPECT_EQ(run(kRunning), 2);
  EXPECT_TRUE(has(faults_, FaultNumber::kDriveMissing, 0));
  EXPECT_TRUE(has(faults_, FaultNumber::kDriveSilent, kDrives - 1));
}

TEST_F(WatchdogsOfAnArm, ADriveUnderWhoseIdentifiersSomebodyElseSpeaksIsNamedTheFirstAndTheLast) {
  for (const int drive : {0, 4, kMaxDrives - 1}) {
    faults_ = {};
    inputs_.twice_mask = 1u << static_cast<std::uint32_t>(drive);
    EXPECT_EQ(run(kUnpowered), 1);
    EXPECT_TRUE(has(faults_, FaultNumber::kNodeTwice, static_cast<std::int16_t>(drive)));
    EXPECT_EQ(faults_.fault[0].detail, 0);
    EXPECT_EQ(faults_.immediate, 1);
  }
}

// 6061 counts only with power: before, a drive may be in any mode.
TEST_F(WatchdogsOfAnArm, ADriveWithPowerThatShowsAnotherModeIsNamedTheFirstAndTheLast) {
  for (const std::size_t drive : {std::size_t{0}, std::size_t{safety_bench::kDrives} - 1}) {
    faults_ = {};
    inputs_ = healthy(kStatusEnabled);
    inputs_.drive[drive].operational = kInOtherMode;
    EXPECT_EQ(run(kUnpowered), 0);
    EXPECT_EQ(run(kRunning), 1);
    ASSERT_EQ(faults_.count, 1);
    EXPECT_TRUE(has(faults_, FaultNumber::kDriveOtherMode, static_cast<std::int16_t>(drive)));
    EXPECT_EQ(faults_.category, StopCategory::kStop);
    EXPECT_EQ(faults_.immediate, 1);
    faults_ = {};
    inputs_.drive[drive].statusword = kStatusDisabled;
    run(kRunning);
    EXPECT_FALSE(has(faults_, FaultNumber::kDriveOtherMode, static_cast<std::int16_t>(drive))) << "3004 says it";
  }
}

TEST(WatchFromStart, EveryDriveHasABitUpToTheLastThatFits) {
  EXPECT_EQ(all_drives(0), 0U);
  EXPECT_EQ(all_drives(1), 1U);
  EXPECT_EQ(all_drives(kMaxDrives - 1), 0x7FFFFFFFU);
  EXPECT_EQ(all_drives(kMaxDrives), 0xFFFFFFFFU);
}

TEST(WatchFromStart, ADriveThatIsNeverHeardIsWatchedAfterTheTimeOfAHeartbeat) {
  LinkLimits limits;
  limits.drive_count = 3;
  limits.heartbeat_age_ticks = 75;
  DriveLinkMonitorState state{};
  FaultList faults{};
  CycleInputs inputs = healthy(kStatusDisabled);
  inputs.drive[1].feedback_age_ticks = 0xFFFF;  // its reports never came
  for (std::uint64_t tick = 1; tick <= 75; ++tick) {
    EXPECT_EQ(faults.count, 0) << tick;
    Watch out(tick, faults);
    watch_from_start(limits, state);
    for (std::int32_t i = 0; i < 3; ++i) watch_drive(limits, kUnpowered, inputs.drive[as_index(i)], i, state, out);
  }
  ASSERT_EQ(faults.count, 1);
  EXPECT_TRUE(has(faults, FaultNumber::kDriveSilent, 1));
}

TEST_F(WatchdogsOfAnArm, ADriveThatLeavesNmtOperationalIsReported) {
  inputs_.drive[0].operational = 0;
  run(kUnpowered);
  EXPECT_TRUE(has(faults_, FaultNumber::kDriveNotOperational, 0));
  EXPECT_EQ(faults_.fault[0].detail, 0);
}

TEST_F(WatchdogsOfAnArm, FaultsOfOneTickAreLatchedBusesFirstThenDriveByDriveAsThePageOfPrioritiesSays) {
  inputs_.lost_bus_mask = 2;
  inputs_.lost_ticks = kToleratedLostTicks + 1;
  inputs_.drive[1] = {kStatusFault, 0, 1000000, 0, kFeedbackAgeTicks + 1, 0xFFFF, 0, 0};
  inputs_.drive[2].statusword = kStatusDisabled;
  inputs_.drive[2].position_counts += 1000000;
  tension_N_[2] = 0.0;
  tension_N_[3] = 700.0;
  watchdogs_.tension.slack_ticks[2] = watchdogs_.tension.alarm_ticks[3] = kSlackDebounceTicks;
  watchdogs_.tension.overload_ticks[3] = watchdogs_.link.following_ticks[2] = kFollowingDebounceTicks;
  run(kRunning);
  using enum FaultNumber;
  const std::vector<std::pair<FaultNumber, int>> order{
      {kBusLost, 1},      {kTicksLost, -1},         {kDriveSilent, 1}, {kDriveMissing, 1},   {kDriveNotOperational, 1},
      {kDriveFault, 1},   {kDriveLeftOperation, 2}, {kCableSlack, 2},  {kFollowingError, 2}, {kTensionAlarm, 3},
      {kCableOverload, 3}};
  ASSERT_EQ(faults_.count, static_cast<std::int32_t>(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(faults_.fault[i].number, order[i].first) << i;
    EXPECT_EQ(faults_.fault[i].index, order[i].second) << i;
  }
}

TEST_F(WatchdogsOfAnArm, ADriveThatWasNeverAliveIsNoFault) {
  watchdogs_ = Watchdogs{};
  inputs_.drive[2] = DriveFeedback{};
  EXPECT_EQ(run(kUnpowered), 0);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(WatchdogsOfAnArm, ADriveThatStillBootsIsNoFaultUntilAllOfItWasAliveOnce) {
  const std::vector<void (*)(DriveFeedback&)> halves{
      [](DriveFeedback& drive) { drive.operational = 0; },
      [](DriveFeedback& drive) { drive.feedback_age_ticks = 0xFFFF; },
      [](DriveFeedback& drive) { drive.heartbeat_age_ticks = 0xFFFF; },
  };
  for (const auto& break_half : halves) {
    watchdogs_ = Watchdogs{};
    faults_ = FaultList{};
    inputs_ = healthy(kStatusDisabled);
    break_half(inputs_.drive[2]);
    EXPECT_EQ(run(kUnpowered), 0);
    inputs_ = healthy(kStatusDisabled);
    EXPECT_EQ(run(kUnpowered), 0);
    break_half(inputs_.drive[2]);
    EXPECT_EQ(run(kUnpowered), 1);
  }
}

TEST_F(WatchdogsOfAnArm, ADriveInFaultIsReportedWithItsEmergencyCodeWhicheverComesFirst) {
  inputs_.drive[1].emergency_code = 0x8130;  // one tick before the statusword
  EXPECT_EQ(run(kUnpowered), 0);
  inputs_.drive[1].emergency_code = 0;
  inputs_.drive[1].statusword = kStatusFaultReaction;
  inputs_.drive[2].statusword = kStatusFault;
  run(kUnpowered);
  inputs_.drive[2].emergency_code = 0x8250;  // one tick after
  EXPECT_EQ(run(kUnpowered), 2);
  ASSERT_EQ(faults_.count, 2);
  EXPECT_EQ(faults_.fault[0].number, FaultNumber::kDriveFault);
  EXPECT_EQ(faults_.fault[0].detail, 0x8130);
  EXPECT_EQ(faults_.fault[1].detail, 0x8250);
}

TEST_F(WatchdogsOfAnArm, AnOldEmergencyCodeIsNotBlamedForALaterFault) {
  inputs_.drive[1].emergency_code = 0x8130;
  run(kRunning);
  inputs_.drive[1].emergency_code = 0;
  run(kRunning);
  inputs_.drive[1].statusword = kStatusFault;
  run(kRunning);
  EXPECT_EQ(faults_.fault[0].detail, 0);
}

TEST_F(WatchdogsOfAnArm, NorIsThatOfADriveWithoutPower) {
  inputs_.drive[1].statusword = kStatusDisabled;
  inputs_.drive[1].emergency_code = 0x8130;
  run(kUnpowered);
  inputs_.drive[1].emergency_code = 0;
  run(kUnpowered);
  inputs_.drive[1].statusword = kStatusFault;
  run(kUnpowered);
  EXPECT_EQ(faults_.fault[0].detail, 0);
}

TEST_F(WatchdogsOfAnArm, EveryStateButOperationEnabledIsLeavingOperationWhilePowered) {
  for (const std::uint16_t status :
       {kStatusDisabled, kStatusReady, kStatusSwitchedOn, kStatusQuickStop, std::uint16_t{0x0001}}) {
    faults_ = FaultList{};
    inputs_ = healthy(kStatusEnabled);
    inputs_.drive[4].statusword = status;
    EXPECT_EQ(run(kUnpowered), 0);
    EXPECT_EQ(run(kRamp), 1);
    EXPECT_TRUE(has(faults_, FaultNumber::kDriveLeftOperation, 4));
    EXPECT_EQ(faults_.fault[0].detail, status);
  }
}

TEST_F(WatchdogsOfAnArm, TheFollowingWindowAllowsTheServosLagAtFullCableSpeed) {
  // 0.2 mm + 1.25 * 10 mm/s * (30 ms + 4 * 4 ms) = 0.775 mm
  EXPECT_EQ(watchdogs_.link_limits.following_counts[0], 775);
  for (const std::int32_t sign : {1, -1}) {
    faults_ = FaultList{};
    inputs_.drive[2].position_counts = 1000000 + sign * 775;
    for (int tick = 0; tick < 100; ++tick) EXPECT_EQ(run(kRunning), 0);
    inputs_.drive[2].position_counts = 1000000 + sign * 776;
    for (int tick = 1; tick < kFollowingDebounceTicks; ++tick) EXPECT_EQ(run(kRunning), 0);
    EXPECT_EQ(run(kUnpowered), 0);  // not watched: the count starts again
    for (int tick = 1; tick < kFollowingDebounceTicks; ++tick) EXPECT_EQ(run(kRunning), 0);
    EXPECT_EQ(run(kRunning), 1);
    EXPECT_TRUE(has(faults_, FaultNumber::kFollowingError, 2));
  }
}

TEST_F(WatchdogsOfAnArm, EveryDriveHasItsOwnFollowingWindow) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i)
    watchdogs_.link_limits.following_counts[i] = 100 * static_cast<std::int64_t>(i + 1);
  for (const int side : {1, -1}) {
    for (std::int16_t drive = 0; drive < kDrives; ++drive) {
      const auto i = static_cast<std::size_t>(drive);
      faults_ = {};
      inputs_.drive[i].position_counts = 1000000 + side * 100 * (drive + 1);
      for (int tick = 0; tick < kFollowingDebounceTicks; ++tick) EXPECT_EQ(run(kRunning), 0) << drive;
      inputs_.drive[i].position_counts += side;
      for (int tick = 0; tick < kFollowingDebounceTicks; ++tick) run(kRunning);
      EXPECT_TRUE(has(faults_, FaultNumber::kFollowingError, drive));
      EXPECT_EQ(faults_.count, 1);
      EXPECT_EQ(faults_.fault[0].detail, 0);
      inputs_.drive[i].position_counts = 1000000;
    }
  }
}

TEST_F(WatchdogsOfAnArm, ACauseThatStaysForMinutesStaysActive) {
  inputs_.drive[0].position_counts = 0;
  for (int tick = 0; tick < kFollowingDebounceTicks; ++tick) run(kRunning);
  for (int tick = 0; tick < 0x10000; ++tick) ASSERT_EQ(run(kRunning), 1) << tick;
}

TEST_F(WatchdogsOfAnArm, ExtremePositionsDoNotOverflowTheFollowingError) {
  sent_[0].target_counts = std::numeric_limits<std::int32_t>::max();
  inputs_.drive[0].position_counts = std::numeric_limits<std::int32_t>::min();
  for (int tick = 0; tick < kFollowingDebounceTicks; ++tick) run(kRunning);
  EXPECT_TRUE(has(faults_, FaultNumber::kFollowingError, 0));
}

struct TensionCase {
  double tension_N;
  WatchScope scope;
  int debounce;  // ticks until the fault; 0 = never
  FaultNumber number;
  const char* why;
};

TEST_F(WatchdogsOfAnArm, TensionIsHeldBetweenFloorAlarmAndHardLimit) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<TensionCase> cases{
      {1.0, kRunning, 0, FaultNumber::kCableSlack, "exactly at the floor"},
      {0.999, kRunning, kSlackDebounceTicks, FaultNumber::kCableSlack, "under the floor"},
      {kNan, kRunning, kSlackDebounceTicks, FaultNumber::kCableSlack, "not a number is slack"},
      {0.0, kRamp, 0, FaultNumber::kCableSlack, "the ramp starts slack"},
      {0.0, kUnpowered, 0, FaultNumber::kCableSlack, "brakes hold: no torque to measure"},
      {400.0, kRunning, 0, FaultNumber::kTensionAlarm, "exactly at the alarm"},
      {400.1, kRunning, kAlarmDebounceTicks, FaultNumber::kTensionAlarm, "over the alarm"},
      {400.1, kRamp, kAlarmDebounceTicks, FaultNumber::kTensionAlarm, "the ramp may not pull too hard either"},
      {600.0, kRunning, 0, FaultNumber::kCableOverload, "at the hard limit"},
      {600.1, kRunning, kOverloadDebounceTicks, FaultNumber::kCableOverload, "over the hard limit"},
      {600.1, kUnpowered, 0, FaultNumber::kCableOverload, "no torque to take away"},
  };
  for (const TensionCase& one : cases) {
    faults_ = FaultList{};
    watchdogs_ = Watchdogs{};
    tension_N_[3] = one.tension_N;
    int first = 0;
    for (int tick = 1; tick <= 100; ++tick) {
      run(one.scope);
      if (first == 0 && has(faults_, one.number, 3)) first = tick;
    }
    EXPECT_EQ(first, one.debounce) << one.why;
  }
}

TEST_F(WatchdogsOfAnArm, OneGoodTickStartsTheDebounceAgain) {
  for (int tick = 0; tick < 200; ++tick) {
    tension_N_[3] = tick % kSlackDebounceTicks == kSlackDebounceTicks - 1 ? 40.0 : 0.0;
    EXPECT_EQ(run(kRunning), 0);
  }
}

TEST_F(WatchdogsOfAnArm, TensionThatIsGoneWhileItsLowPassIsStillFirmIsABreak) {
  tension_N_[3] = 0.0;
  lowpass_N_[3] = 8.0;
  for (int tick = 1; tick < kBreakDebounceTicks; ++tick) run(kRunning);
  EXPECT_EQ(faults_.count, 0);
  run(kRunning);
  EXPECT_TRUE(has(faults_, FaultNumber::kCableBreak, 3));
  EXPECT_EQ(faults_.immediate, 0);
}

TEST_F(WatchdogsOfAnArm, TensionThatFadedIsNoBreak) {
  tension_N_[3] = 0.0;
  lowpass_N_[3] = 7.0;
  for (int tick = 0; tick < 100; ++tick) run(kRunning);
  EXPECT_FALSE(has(faults_, FaultNumber::kCableBreak, 3));
}

TEST_F(WatchdogsOfAnArm, AReadingFarBelowNothingIsNoBreak) {
  tension_N_[3] = -8.0;
  lowpass_N_[3] = 40.0;
  for (int tick = 0; tick < 100; ++tick) run(kRunning);
  EXPECT_FALSE(has(faults_, FaultNumber::kCableBreak, 3));
  EXPECT_TRUE(has(faults_, FaultNumber::kCableSlack, 3));
}

TEST_F(WatchdogsOfAnArm, AMotorThatLetItsCableGoIsNoBreak) {
  tension_N_[3] = 0.0;
  lowpass_N_[3] = 40.0;
  inputs_.drive[3].position_counts += 100000;
  for (int tick = 0; tick < 100; ++tick) run(kRunning);
  EXPECT_FALSE(has(faults_, FaultNumber::kCableBreak, 3));
  EXPECT_TRUE(has(faults_, FaultNumber::kFollowingError, 3));
}

TEST_F(WatchdogsOfAnArm, EveryLostBusIsNamedTheFirstAndTheLast) {
  for (const int bus : {0, 1, 31}) {
    faults_ = {};
    inputs_.lost_bus_mask = 1u << static_cast<std::uint32_t>(bus);
    EXPECT_EQ(run(kUnpowered), 1);
    EXPECT_TRUE(has(faults_, FaultNumber::kBusLost, static_cast<std::int16_t>(bus)));
    EXPECT_EQ(faults_.fault[0].detail, 0);
  }
}

TEST_F(WatchdogsOfAnArm, TwoLostTicksInARowAreToleratedThreeAreNot) {
  inputs_.lost_ticks = 2;
  EXPECT_EQ(run(kRunning), 0);
  inputs_.lost_ticks = 3;
  EXPECT_EQ(run(kUnpowered), 0);
  EXPECT_EQ(run(kRunning), 1);
  EXPECT_TRUE(has(faults_, FaultNumber::kTicksLost, -1));
}

TEST_F(WatchdogsOfAnArm, ACauseThatIsGoneIsNoLongerActiveButStaysLatched) {
  inputs_.drive[3].feedback_age_ticks = 3;
  run(kRunning);
  inputs_.drive[3].feedback_age_ticks = 0;
  EXPECT_EQ(run(kRunning), 0);
  EXPECT_EQ(faults_.count, 1);
}

TEST_F(WatchdogsOfAnArm, DrivesBeyondTheTableAreNotLookedAt) {
  inputs_.drive[static_cast<std::size_t>(kDrives)].statusword = kStatusFault;
  EXPECT_EQ(run(kRunning), 0);
}

}  // namespace
}  // namespace liana::cable
