// Each fault that sits in a drive, seen on the wire.
#include "drive_harness.hpp"

namespace liana::bench {
namespace {

class DriveFaults : public DriveHarness {
 protected:
  static constexpr std::uint32_t kTpdo = 0x180 + kNode;

  DriveFaults() {
    boot();
    configure();
    enable();
  }

  // The TPDO of one period in which the target is `target`.
  std::optional<CanFrame> report(std::int32_t target) { return find(cycle(0x0F, target), kTpdo); }

  std::int32_t position(std::int32_t target) {
    const auto frame = report(target);
    EXPECT_TRUE(frame);
    return frame ? static_cast<std::int32_t>(get_little_endian(&frame->data[2], 4)) : 0;
  }

  void settle(std::int32_t target, int periods = 200) {
    for (int i = 0; i < periods; ++i) {
      give(0x77F, {0x05});
      cycle(0x0F, target);
    }
  }
};

TEST_F(DriveFaults, ALateDriveReportsWhatWasTrueSoManyPeriodsBefore) {
  std::vector<std::int32_t> prompt;
  settle(1000);
  drive_.defects().late_cycles = 2;
  EXPECT_FALSE(report(1000)) << "the first answers are still to come";
  EXPECT_FALSE(report(1000));
  for (int i = 0; i < 10; ++i) {
    const std::int32_t reported = position(3000);
    prompt.push_back(static_cast<std::int32_t>(*read(0x6064, 0)));
    if (i < 4) {
      EXPECT_EQ(reported, 1000)
          << "the target came a period after the first SYNC, acts a period later, and is told two later";
    } else {
      EXPECT_GT(reported, 1000);
    }
  }
  drive_.defects().late_cycles = 0;
  EXPECT_GT(position(3000), 1000) << "late no more, and answering at once";
  EXPECT_GT(prompt.back(), prompt.front());
}

TEST_F(DriveFaults, AStuckDriveReportsTheSameValuesWhileItsMotorMoves) {
  settle(1000);
  drive_.set_measured(77.0);
  position(1000);
  drive_.defects().stuck = true;
  drive_.set_measured(500.0);
  settle(3000, 50);
  const auto frame = report(3000);
  ASSERT_TRUE(frame);
  EXPECT_EQ(get_little_endian(&frame->data[2], 4), 1000U);
  EXPECT_EQ(get_little_endian(&frame->data[6], 2), 77U);
  EXPECT_GT(drive_.motor().position_counts(), 2900.0);
  drive_.defects().stuck = false;
  EXPECT_GT(position(3000), 2900);
}

TEST_F(DriveFaults, AWrongPdoLengthIsOnTheWireAndNothingElseChanges) {
  drive_.defects().pdo_length = 7;
  const auto frame = report(1000);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->length, 7);
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
}

TEST_F(DriveFaults, AnEmergencyReportIsSentOnceAndTheDriveGoesOn) {
  drive_.report_emergency(0x4210);
  EXPECT_EQ(emergency(cycle(0x0F, 1000)), 0x4210);
  EXPECT_EQ(emergency(cycle(0x0F, 1000)), -1);
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
}

TEST_F(DriveFaults, ADriveThatRebootsBootsUpWithPowerOnValuesAndABrakeThatHolds) {
  drive_.power_off();
  EXPECT_TRUE(cycle(0x0F, 1000).empty());
  drive_.power_on();
  const FrameList frames = tick();
  const auto boot_up = find(frames, 0x700 + kNode);
  ASSERT_TRUE(boot_up);
  EXPECT_EQ(boot_up->data[0], 0);
  EXPECT_EQ(drive_.nmt_state(), NmtState::kPreOperational);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  EXPECT_EQ(drive_.motor().mode(), MotorMode::kBraked);
  EXPECT_EQ(read(0x6060, 0), 0U) << "the mode is not stored";
  EXPECT_FALSE(report(1000)) << "no PDOs before it is started";
  configure();
  enable();
  EXPECT_TRUE(report(1000)) << "and it is as good as before";
}

TEST_F(DriveFaults, ARebootMayGiveItAnotherIdentityThatStays) {
  drive_.power_off();
  drive_.set_identity(2);
  drive_.power_on();
  boot();
  EXPECT_EQ(read(0x1018, 2), 2U);
}

TEST_F(DriveFaults, ASlowResetIsSilentAndDeafUntilItsBootUpMessage) {
  drive_.defects().reset_us = 600000;
  EXPECT_TRUE(give(0x000, {0x82, kNode}).empty());
  EXPECT_TRUE(tick(500000).empty());
  EXPECT_TRUE(give(0x000, {0x82, kNode}).empty()) << "a second reset does not prolong it";
  const auto boot_up = find(tick(100000), 0x700 + kNode);
  ASSERT_TRUE(boot_up);
  EXPECT_EQ(boot_up->data[0], 0);
  EXPECT_EQ(read(0x6060, 0), 8U) << "it listens again";
}

TEST_F(DriveFaults, ASlowDriveTakesItsTimeForEachTransitionUpAndNoneForThoseDown) {
  drive_.defects().power_us = 300000;
  for (int i = 0; i < 3; ++i) cycle(0x00, 1000);
  ASSERT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
  for (const auto& [controlword, state] :
       {std::pair{0x06, PowerState::kReadyToSwitchOn}, std::pair{0x07, PowerState::kSwitchedOn},
        std::pair{0x0F, PowerState::kOperationEnabled}}) {
    for (int i = 0; i < 75; ++i) {
      give(0x77F, {0x05});
      cycle(controlword, 1000);
      ASSERT_NE(drive_.power_state(), state) << i;
    }
    for (int i = 0; i < 3; ++i) cycle(controlword, 1000);
    EXPECT_EQ(drive_.power_state(), state);
  }
  cycle(0x00, 1000);
  cycle(0x00, 1000);
  EXPECT_EQ(drive_.power_state(), PowerState::kSwitchOnDisabled);
}

TEST_F(DriveFaults, ASlowSdoServerAnswersAllTheSameInOrder) {
  drive_.defects().sdo_us = 400000;
  EXPECT_TRUE(sdo({0x40, 0x00, 0x10, 0}).empty());
  EXPECT_TRUE(sdo({0x40, 0x18, 0x10, 1}).empty());
  EXPECT_FALSE(find(tick(399000), 0x580 + kNode));
  const FrameList out = tick(1000);
  ASSERT_GE(out.size(), 2U);
  EXPECT_EQ(out[0].data[1], 0x00);
  EXPECT_EQ(out[1].data[1], 0x18);
}

TEST_F(DriveFaults, WithoutReportsAllElseGoesOn) {
  drive_.defects().no_reports = true;
  EXPECT_FALSE(report(1000));
  EXPECT_EQ(read(0x6060, 0), 8U);
  EXPECT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
}

TEST_F(DriveFaults, TwoDrivesOfOneNodeIdSayAllTwiceAndReportTwoPlaces) {
  drive_.defects().twice = true;
  const FrameList out = cycle(0x0F, 1000);
  std::vector<CanFrame> reports;
  for (const CanFrame& frame : out)
    if (frame.id == kTpdo) reports.push_back(frame);
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_NE(reports[0].data, reports[1].data);
  EXPECT_EQ(give(0x600 + kNode, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0}).size(), 2U);
}

TEST_F(DriveFaults, AnEncoderThatJumpsMovesTheMotorBackByAsMuchAndReadsTheTargetAgain) {
  settle(1000);
  drive_.jump_encoder(400.0);
  EXPECT_EQ(position(1000), 1400) << "what it reads at once";
  settle(1000);
  EXPECT_EQ(position(1000), 1000);
  EXPECT_NEAR(drive_.motor().position_counts(), 600.0, 1.0) << "the cable is somewhere else now";
}

TEST_F(DriveFaults, ASaturatedMotorDoesNotWindUpButPaysOut) {
  settle(1000);
  drive_.defects().most_torque_permille = 40.0;  // the harness loads it with 50
  settle(0);
  EXPECT_EQ(drive_.motor().position_counts(), 1000.0) << "counts fall while cable is wound up";
  settle(2000);
  EXPECT_NEAR(drive_.motor().position_counts(), 2000.0, 1.0);
}

TEST_F(DriveFaults, ASaturatedMotorThatIsWellAgainFollows) {
  settle(1000);
  drive_.defects().most_torque_permille = 40.0;
  settle(0, 10);
  drive_.defects().most_torque_permille = 1000.0;
  settle(0);
  EXPECT_NEAR(drive_.motor().position_counts(), 0.0, 1.0);
}

}  // namespace
}  // namespace liana::bench
