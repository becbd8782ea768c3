// A19, C11: the gate. Every check is tried just inside (unchanged) and just outside (refused for all drives).
#include "firmware_like/safety/gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "firmware_like/math/convert.hpp"
#include "tests/firmware_like/safety_bench.hpp"

namespace liana {
namespace {

using namespace safety_bench;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
constexpr std::int32_t kIntMax = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t kIntMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t kStep = 51;  // 10 mm/s * 4 ms * 1.25 = 50 counts of 1 um, and one of rounding

// A gate in the middle of a motion: every drive enabled, standing at its last target.
class Gate : public ::testing::Test {
 protected:
  Gate() {
    proposal_.goal = DriveGoal::kOperationEnabled;
    proposal_.live_targets = true;
    proposal_.payout_m = zero_payout_m();
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      proposal_.tension_plan_N[i] = 40.0;
      previous_[i] = {kEnableOperation, 1000000};
      feedback_[i].position_counts = 999990;  // lags a little behind the target
    }
  }

  GateResult judge() const { return gate(robot_, limits_, proposal_, previous_, feedback_); }

  // Expects the proposal unchanged at the drives.
  void expect_passed(const std::string& why) const {
    const GateResult result = judge();
    EXPECT_EQ(result.check, GateCheck::kPassed) << why;
    EXPECT_EQ(result.drive, -1) << why;
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      const Counts wanted = counts_at_payout(robot_.drive[i], kZeroPayout_m, proposal_.payout_m[i]);
      EXPECT_EQ(result.command[i].target_counts, wanted.value) << why << ", drive " << i;
      EXPECT_EQ(result.command[i].controlword, kEnableOperation) << why;
    }
  }

  // Expects previous targets for all drives, and the reason.
  void expect_refused(GateCheck check, std::int16_t drive, const std::string& why) const {
    const GateResult result = judge();
    EXPECT_EQ(result.check, check) << why;
    EXPECT_EQ(result.drive, drive) << why;
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      EXPECT_EQ(result.command[i].target_counts, previous_[i].target_counts) << why << ", drive " << i;
    }
  }

  RobotTable robot_ = table();
  GateLimits limits_ = make_gate_limits(robot_, zero_payout_m());
  GateProposal proposal_{};
  std::array<DriveCommand, kMaxCables> previous_{};
  std::array<DriveFeedback, kMaxCables> feedback_ = healthy(kStatusEnabled).drive;
};

TEST_F(Gate, LimitsAreThoseOfTheTable) {
  EXPECT_EQ(limits_.drive_count, kDrives);
  EXPECT_EQ(limits_.tension_ceiling_N, 150.0);
  const double arm_m = std::sqrt(0.025 * 0.025 + 0.010 * 0.010);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    const double bend_m = arm_m * 2.0 * 0.35 * (i < 3 ? 8.0 : 16.0);
    const double elongation_m = (1.3 + bend_m) * 600.0 / 240000.0;
    EXPECT_NEAR(limits_.least_payout_m[i], 1.3 - bend_m - elongation_m, 1e-15);
    EXPECT_NEAR(limits_.most_payout_m[i], 1.3 + bend_m + elongation_m, 1e-15);
    EXPECT_EQ(limits_.step_counts[i], kStep);
  }
}

TEST_F(Gate, AProposalInsideEveryLimitReachesEveryDriveUnchanged) {
  expect_passed("standing");
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i)
    proposal_.payout_m[i] += 1e-6 * static_cast<double>(i + 1);
  expect_passed("each drive another target");
}

TEST_F(Gate, TheLargestStepPassesAndOneCountMoreIsRefusedForEveryDriveInBothDirections) {
  for (std::int16_t drive = 0; drive < kDrives; ++drive) {
    for (const double sign : {1.0, -1.0}) {
      const auto i = static_cast<std::size_t>(drive);
      proposal_.payout_m = zero_payout_m();
      proposal_.payout_m[i] += sign * static_cast<double>(kStep) * kMetresPerCount;
      expect_passed("largest step");
      proposal_.payout_m[i] += sign * kMetresPerCount;
      expect_refused(GateCheck::kStepTooLarge, drive, "one count more");
    }
  }
}

TEST_F(Gate, TheStepIsMeasuredFromTheTargetSentLastNotFromThePosition) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) feedback_[i].position_counts = 0;
  expect_passed("position far away");
  previous_[2].target_counts = 1000000 + static_cast<std::int32_t>(kStep) + 1;
  expect_refused(GateCheck::kStepTooLarge, 2, "last target far away");
}

TEST_F(Gate, PayoutsUpToTheRangeAreAllowedAndTheNextNumberIsNot) {
  for (std::int16_t drive = 0; drive < kDrives; ++drive) {
    const auto i = static_cast<std::size_t>(drive);
    for (const double edge_m : {limits_.least_payout_m[i], limits_.most_payout_m[i]}) {
      proposal_.payout_m = zero_payout_m();
      proposal_.payout_m[i] = edge_m;
      previous_[i].target_counts = counts_at_payout(robot_.drive[i], kZeroPayout_m, edge_m).value;
      expect_passed("at the edge");
      proposal_.payout_m[i] = std::nextafter(edge_m, edge_m < 1.3 ? -kInf : kInf);
      expect_refused(GateCheck::kPayoutOutOfRange, drive, "next number outside");
      previous_[i].target_counts = 1000000;
    }
  }
}

struct BadNumber {
  double value;
  GateCheck as_payout;
  GateCheck as_tension;
  const char* why;
};

TEST_F(Gate, NumbersThatAreNoLengthOrTensionAreRefusedWhereverTheyStand) {
  const std::vector<BadNumber> bad{
      {kNan, GateCheck::kPayoutNotFinite, GateCheck::kTensionNotFinite, "NaN"},
      {-kNan, GateCheck::kPayoutNotFinite, GateCheck::kTensionNotFinite, "-NaN"},
      {kInf, GateCheck::kPayoutNotFinite, GateCheck::kTensionNotFinite, "infinity"},
      {-kInf, GateCheck::kPayoutNotFinite, GateCheck::kTensionNotFinite, "-infinity"},
      {1.7e308, GateCheck::kPayoutOutOfRange, GateCheck::kTensionOutOfRange, "largest numbers"},
      {-1.7e308, GateCheck::kPayoutOutOfRange, GateCheck::kTensionOutOfRange, "largest negative numbers"},
      {-kDenormal, GateCheck::kPayoutOutOfRange, GateCheck::kTensionOutOfRange, "a cable cannot push"},
      {kDenormal, GateCheck::kPayoutOutOfRange, GateCheck::kPassed, "a denormal is a tension but no length"},
      {0.0, GateCheck::kPayoutOutOfRange, GateCheck::kPassed, "zero is a tension but no length"},
      {-0.0, GateCheck::kPayoutOutOfRange, GateCheck::kPassed, "so is minus zero"},
      {2147483648.0, GateCheck::kPayoutOutOfRange, GateCheck::kTensionOutOfRange, "one over INT_MAX"},
  };
  const GateProposal good = proposal_;
  for (const BadNumber& one : bad) {
    for (std::int16_t drive = 0; drive < kDrives; ++drive) {
      const auto i = static_cast<std::size_t>(drive);
      proposal_ = good;
      proposal_.payout_m[i] = one.value;
      expect_refused(one.as_payout, drive, std::string("payout ") + one.why);
      proposal_ = good;
      proposal_.tension_plan_N[i] = one.value;
      if (one.as_tension == GateCheck::kPassed) {
        expect_passed(std::string("tension ") + one.why);
      } else {
        expect_refused(one.as_tension, drive, std::string("tension ") + one.why);
      }
    }
  }
}

TEST_F(Gate, PlannedTensionMayReachTheCeilingAndNotMore) {
  proposal_.tension_plan_N[5] = 150.0;
  expect_passed("at the ceiling");
  proposal_.tension_plan_N[5] = std::nextafter(150.0, kInf);
  expect_refused(GateCheck::kTensionOutOfRange, 5, "next number");
}

TEST_F(Gate, CountsThatDoNotFitInto32BitsAreRefusedNotWrapped) {
  robot_.drive[1].zero_counts = kIntMin;  // direction -1: the target is what the payout is short of the zero's
  previous_[1].target_counts = kIntMin;
  proposal_.payout_m[1] = kZeroPayout_m - 10e-6;
  expect_passed("just inside 32 bits");
  proposal_.payout_m[1] = kZeroPayout_m + 10e-6;
  expect_refused(GateCheck::kPayoutOutOfRange, 1, "just outside");
}

TEST_F(Gate, AStepAcrossTheWholeIntegerRangeDoesNotOverflow) {
  previous_[0].target_counts = kIntMin;
  expect_refused(GateCheck::kStepTooLarge, 0, "from INT_MIN");
  previous_[0].target_counts = kIntMax;
  expect_refused(GateCheck::kStepTooLarge, 0, "from INT_MAX");
}

TEST_F(Gate, TheFirstDriveThatFailsIsNamed) {
  proposal_.payout_m[4] = kNan;
  proposal_.tension_plan_N[2] = 1000.0;
  expect_refused(GateCheck::kTensionOutOfRange, 2, "two drives fail");
}

TEST_F(Gate, MotionWithOneDriveOutOfOperationIsRefusedForAll) {
  for (const std::uint16_t status : {kStatusDisabled, kStatusReady, kStatusSwitchedOn, kStatusQuickStop,
                                     kStatusFaultReaction, kStatusFault, std::uint16_t{0x0001}}) {
    feedback_[3].statusword = status;
    const GateResult result = judge();
    EXPECT_EQ(result.check, GateCheck::kDriveNotEnabled);
    EXPECT_EQ(result.drive, 3);
    EXPECT_EQ(result.command[0].target_counts, 1000000);
  }
}

TEST_F(Gate, ADriveWithoutTorqueGetsItsActualPosition) {
  proposal_.live_targets = false;
  for (const std::uint16_t status :
       {kStatusDisabled, kStatusReady, kStatusSwitchedOn, kStatusFault, std::uint16_t{0x0001}}) {
    feedback_[3].statusword = status;
    feedback_[3].position_counts = kIntMax;
    const GateResult result = judge();
    EXPECT_EQ(result.check, GateCheck::kPassed);
    EXPECT_EQ(result.command[3].target_counts, kIntMax);
    EXPECT_EQ(result.command[0].target_counts, 1000000) << "a drive with torque holds its last target";
  }
}

TEST_F(Gate, WhileTargetsAreNotLiveNothingOfTheProposalReachesADrive) {
  proposal_.live_targets = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) proposal_.payout_m[i] = i % 2 == 0 ? kNan : 1.31;
  const GateResult result = judge();
  EXPECT_EQ(result.check, GateCheck::kPassed);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i)
    EXPECT_EQ(result.command[i].target_counts, 1000000);
}

TEST_F(Gate, ATargetFromBeforeThePowerIsNeverHeld) {
  proposal_.live_targets = false;
  previous_[0] = {kDisableVoltage, 123};  // as after start, with a drive that somebody else had enabled
  EXPECT_EQ(judge().command[0].target_counts, feedback_[0].position_counts);
}

TEST_F(Gate, EnablingIsBumpless) {
  // Tick by tick as a drive goes from Switched on to Operation enabled while its motor creeps by a few counts.
  proposal_.live_targets = false;
  previous_[0] = {kSwitchOn, 500};
  feedback_[0] = {kStatusSwitchedOn, 0, 503, 0, 0, 0, 1};
  GateResult result = judge();
  EXPECT_EQ(result.command[0].controlword, kEnableOperation);
  EXPECT_EQ(result.command[0].target_counts, 503) << "the target with which the brake opens is the position";
  previous_ = result.command;
  feedback_[0] = {kStatusEnabled, 0, 505, 0, 0, 0, 1};
  result = judge();
  EXPECT_EQ(result.command[0].target_counts, 503) << "from then on it holds and does not drift with the position";
}

TEST_F(Gate, ControlwordsFollowTheGoalAndTheDrivesState) {
  proposal_.live_targets = false;
  proposal_.goal = DriveGoal::kQuickStop;
  feedback_[1].statusword = kStatusFault;
  feedback_[2].statusword = kStatusQuickStop;
  const GateResult result = judge();
  EXPECT_EQ(result.command[0].controlword, kQuickStopCommand);
  EXPECT_EQ(result.command[1].controlword, kDisableVoltage);
  EXPECT_EQ(result.command[2].controlword, kQuickStopCommand);
}

TEST_F(Gate, ARefusalBecomesAFaultThatNamesDriveAndCheck) {
  EXPECT_EQ(gate_fault(judge(), 9).number, FaultNumber::kNone);
  proposal_.payout_m[2] = kNan;
  const Fault fault = gate_fault(judge(), 9);
  EXPECT_EQ(fault.number, FaultNumber::kGateRefused);
  EXPECT_EQ(fault.index, 2);
  EXPECT_EQ(fault.detail, static_cast<std::uint16_t>(GateCheck::kPayoutNotFinite));
  EXPECT_EQ(fault.tick, 9U);
  EXPECT_STREQ(gate_check_name(GateCheck::kPayoutNotFinite), "payout_not_finite");
  EXPECT_STREQ(gate_check_name(static_cast<GateCheck>(7)), "unknown");
}

TEST_F(Gate, TheGateIsPure) {
  proposal_.payout_m[0] += 20e-6;
  const GateResult first = judge();
  const GateResult second = judge();
  for (std::size_t i = 0; i < static_cast<std::size_t>(kMaxCables); ++i) {
    EXPECT_EQ(first.command[i].target_counts, second.command[i].target_counts);
    EXPECT_EQ(first.command[i].controlword, second.command[i].controlword);
  }
}

}  // namespace
}  // namespace liana
