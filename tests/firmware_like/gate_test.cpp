// The gate (req:A19). Every check is tried just inside (unchanged) and just outside (refused for all drives).
#include "firmware_like/safety/gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/firmware_like/extremes.hpp"
#include "tests/firmware_like/safety_bench.hpp"

namespace liana {
namespace {

using namespace cable::safety_bench;

constexpr std::int64_t kStep = 51;  // 10 mm/s * 4 ms * 1.25 = 50 counts of 1 um, and one of rounding

constexpr std::int32_t kZeroCounts = 1000000;
constexpr double kLeast_counts = 400000.0;
constexpr double kMost_counts = 1700000.0;
constexpr double kMost_permille = 250.0;

// Six drives that may turn by kStep counts a tick within a range, and pull but not push.
GateLimits six_drives() {
  GateLimits limits{};
  limits.drive_count = kDrives;
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    limits.drive[i] = {DriveMode::kCyclicPosition, kLeast_counts, kMost_counts, kStep, 0.0, kMost_permille};
  }
  return limits;
}

// A gate in the middle of a motion: every drive enabled, standing at its last target.
class Gate : public ::testing::Test {
 protected:
  Gate() {
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      proposal_[i] = {DriveMode::kCyclicPosition, kZeroCounts, 66.7};
      previous_[i] = {kEnableOperation, kZeroCounts};
      feedback_[i].position_counts = 999990;  // lags a little behind the target
    }
  }

  GateResult judge() const { return gate(limits_, goal_, live_, proposal_, previous_, feedback_); }

  // Expects the proposal, rounded, at the drives.
  void expect_passed(const std::string& why) const {
    const GateResult result = judge();
    EXPECT_EQ(result.check, GateCheck::kPassed) << why;
    EXPECT_EQ(result.drive, -1) << why;
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      EXPECT_EQ(result.command[i].target_counts, std::lround(proposal_[i].target_counts)) << why << ", drive " << i;
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

  GateLimits limits_ = six_drives();
  DriveGoal goal_ = DriveGoal::kOperationEnabled;
  bool live_ = true;
  DriveProposals proposal_{};
  DriveCommands previous_{};
  DriveFeedbacks feedback_ = healthy(kStatusEnabled).drive;
};

TEST_F(Gate, AProposalInsideEveryLimitReachesEveryDriveUnchanged) {
  expect_passed("standing");
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i)
    proposal_[i].target_counts += static_cast<double>(i + 1);
  expect_passed("each drive another target");
}

TEST_F(Gate, TheLargestStepPassesAndOneCountMoreIsRefusedForEveryDriveInBothDirections) {
  for (std::int16_t drive = 0; drive < kDrives; ++drive) {
    for (const double sign : {1.0, -1.0}) {
      const auto i = static_cast<std::size_t>(drive);
      proposal_[i].target_counts = kZeroCounts + sign * static_cast<double>(kStep);
      expect_passed("largest step");
      proposal_[i].target_counts += sign;
      expect_refused(GateCheck::kStepTooLarge, drive, "one count more");
      proposal_[i].target_counts = kZeroCounts;
    }
  }
}

TEST_F(Gate, TheStepIsMeasuredFromTheTargetSentLastNotFromThePosition) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) feedback_[i].position_counts = 0;
  expect_passed("position far away");
  previous_[2].target_counts = 1000000 + static_cast<std::int32_t>(kStep) + 1;
  expect_refused(GateCheck::kStepTooLarge, 2, "last target far away");
}

TEST_F(Gate, ADriveThatLetsGoMayJumpItsWayAndNoFurtherAndOnlyWhenItSaysSo) {
  for (const std::int64_t way : {8000, -8000}) {
    limits_.drive[1].let_go_counts = way;
    proposal_[1].target_counts = kZeroCounts + static_cast<double>(way);
    proposal_[1].lets_go = false;
    expect_refused(GateCheck::kStepTooLarge, 1, "it does not say so");
    proposal_[1].lets_go = true;
    expect_passed("as far as it may");
    proposal_[1].target_counts += way > 0 ? 1.0 : -1.0;
    expect_refused(GateCheck::kStepTooLarge, 1, "one count more");
    proposal_[1].target_counts = kZeroCounts - static_cast<double>(way);
    expect_refused(GateCheck::kStepTooLarge, 1, "the other way");
  }
  limits_.drive[1].let_go_counts = 0;
  proposal_[1].target_counts = kZeroCounts + 1000.0;
  expect_refused(GateCheck::kStepTooLarge, 1, "no cable to let go");
}

TEST_F(Gate, ADriveThatLetsGoMayTakeItsTargetBackToWhereTheMotorStands) {
  limits_.drive[1].let_go_counts = 8000;
  previous_[1].target_counts = kZeroCounts + 5000;
  feedback_[1].position_counts = kZeroCounts + 600;
  proposal_[1].lets_go = true;
  proposal_[1].target_counts = kZeroCounts + 600.0 - static_cast<double>(kStep);
  expect_passed("to the motor, and a step past it");
  proposal_[1].target_counts -= 1.0;
  expect_refused(GateCheck::kStepTooLarge, 1, "one count further");
  proposal_[1].target_counts = kZeroCounts + 600.0;
  proposal_[1].lets_go = false;
  expect_refused(GateCheck::kStepTooLarge, 1, "it does not say so");
  proposal_[1].lets_go = true;
  limits_.drive[1].let_go_counts = 0;
  expect_refused(GateCheck::kStepTooLarge, 1, "no cable to let go");
}

TEST_F(Gate, TheWayBackToTheMotorIsBoundedOnBothSides) {
  struct Row {
    std::int32_t motor, target;  // from the target sent last
    bool passes;
    const char* why;
  };
  for (const std::int32_t sign : {1, -1}) {
    limits_.drive[1].let_go_counts = -sign;  // its own jump is shorter than a step
    proposal_[1].lets_go = true;
    for (const Row& row : {Row{600, 651, true, "a step past the motor"}, Row{600, 652, false, "one count more"},
                           Row{600, 52, true, "on the way"}, Row{600, -52, false, "away from it"},
                           Row{0, 51, true, "a step"}, Row{0, 52, false, "the motor stands at the target"}}) {
      feedback_[1].position_counts = kZeroCounts + sign * row.motor;
      proposal_[1].target_counts = kZeroCounts + sign * row.target;
      if (row.passes) {
        expect_passed(row.why);
      } else {
        expect_refused(GateCheck::kStepTooLarge, 1, row.why);
      }
    }
  }
}

TEST_F(Gate, EveryDriveIsJudgedByItsOwnLimitsAndLastCommand) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    const auto own = static_cast<double>(i);
    limits_.drive[i].step_counts = kStep + static_cast<std::int64_t>(i);
    limits_.drive[i].max_permille = kMost_permille + own;
    previous_[i].target_counts = kZeroCounts + 1000 * static_cast<std::int32_t>(i);
    proposal_[i].target_counts = previous_[i].target_counts + static_cast<double>(kStep) + own;
    proposal_[i].torque_permille = kMost_permille + own;
  }
  expect_passed("each at its own limits");
  goal_ = DriveGoal::kFaultReset;
  for (DriveFeedback& drive : feedback_) drive.statusword = kStatusFault;
  previous_[0].controlword = kFaultResetBit;
  for (const bool live : {true, false}) {
    live_ = live;
    const GateResult result = judge();
    EXPECT_EQ(result.command[0].controlword, kDisableVoltage) << "the edge of this drive is spent";
    EXPECT_EQ(result.command[kDrives - 1].controlword, kFaultResetBit);
  }
}

TEST_F(Gate, TargetsUpToTheRangeAreAllowedAndTheNextNumberIsNot) {
  for (std::int16_t drive = 0; drive < kDrives; ++drive) {
    const auto i = static_cast<std::size_t>(drive);
    for (const double edge : {kLeast_counts, kMost_counts}) {
      proposal_[i].target_counts = edge;
      previous_[i].target_counts = static_cast<std::int32_t>(edge);
      expect_passed("at the edge");
      proposal_[i].target_counts = std::nextafter(edge, edge < kZeroCounts ? -kInf : kInf);
      expect_refused(GateCheck::kTargetOutOfRange, drive, "next number outside");
      previous_[i].target_counts = kZeroCounts;
      proposal_[i].target_counts = kZeroCounts;
    }
  }
}

struct BadNumber {
  double value;
  GateCheck as_target;
  GateCheck as_torque;
  const char* why;
};

TEST_F(Gate, NumbersThatAreNoTargetOrTorqueAreRefusedWhereverTheyStand) {
  const std::vector<BadNumber> bad{
      {kNan, GateCheck::kTargetNotFinite, GateCheck::kTorqueNotFinite, "NaN"},
      {-kNan, GateCheck::kTargetNotFinite, GateCheck::kTorqueNotFinite, "-NaN"},
      {kInf, GateCheck::kTargetNotFinite, GateCheck::kTorqueNotFinite, "infinity"},
      {-kInf, GateCheck::kTargetNotFinite, GateCheck::kTorqueNotFinite, "-infinity"},
      {1.7e308, GateCheck::kTargetOutOfRange, GateCheck::kTorqueOutOfRange, "largest numbers"},
      {-1.7e308, GateCheck::kTargetOutOfRange, GateCheck::kTorqueOutOfRange, "largest negative numbers"},
      {-kDenormal, GateCheck::kTargetOutOfRange, GateCheck::kTorqueOutOfRange, "a cable drive cannot push"},
      {kDenormal, GateCheck::kTargetOutOfRange, GateCheck::kPassed, "a denormal is a torque but no target here"},
      {0.0, GateCheck::kTargetOutOfRange, GateCheck::kPassed, "zero is a torque but no target here"},
      {-0.0, GateCheck::kTargetOutOfRange, GateCheck::kPassed, "so is minus zero"},
      {2147483648.0, GateCheck::kTargetOutOfRange, GateCheck::kTorqueOutOfRange, "one over INT_MAX"},
  };
  const DriveProposals good = proposal_;
  for (const BadNumber& one : bad) {
    for (std::int16_t drive = 0; drive < kDrives; ++drive) {
      const auto i = static_cast<std::size_t>(drive);
      proposal_ = good;
      proposal_[i].target_counts = one.value;
      expect_refused(one.as_target, drive, std::string("target ") + one.why);
      proposal_ = good;
      proposal_[i].torque_permille = one.value;
      if (one.as_torque == GateCheck::kPassed) {
        expect_passed(std::string("torque ") + one.why);
      } else {
        expect_refused(one.as_torque, drive, std::string("torque ") + one.why);
      }
    }
  }
}

TEST_F(Gate, TorqueMayReachItsLimitAndNotMore) {
  proposal_[5].torque_permille = kMost_permille;
  expect_passed("at the ceiling");
  proposal_[5].torque_permille = std::nextafter(kMost_permille, kInf);
  expect_refused(GateCheck::kTorqueOutOfRange, 5, "next number");
}

TEST_F(Gate, CountsThatDoNotFitInto32BitsAreRefusedNotWrapped) {
  limits_.drive[1].min_counts = -1e12;
  previous_[1].target_counts = kIntMin;
  proposal_[1].target_counts = static_cast<double>(kIntMin) + 10.0;
  expect_passed("just inside 32 bits");
  proposal_[1].target_counts = static_cast<double>(kIntMin) - 10.0;
  expect_refused(GateCheck::kTargetOutOfRange, 1, "just outside");
}

TEST_F(Gate, AStepAcrossTheWholeIntegerRangeDoesNotOverflow) {
  previous_[0].target_counts = kIntMin;
  expect_refused(GateCheck::kStepTooLarge, 0, "from INT_MIN");
  previous_[0].target_counts = kIntMax;
  expect_refused(GateCheck::kStepTooLarge, 0, "from INT_MAX");
}

TEST_F(Gate, AModeThatTheDriveWasNotConfiguredForIsRefused) {
  proposal_[3].mode = DriveMode::kCyclicTorque;
  expect_refused(GateCheck::kModeNotAllowed, 3, "torque in cyclic position");
  limits_.drive[3].mode = DriveMode::kCyclicTorque;
  limits_.drive[3].torque_step_permille = kMost_permille;
  expect_passed("torque in cyclic torque");
}

TEST_F(Gate, TheFirstDriveThatFailsIsNamed) {
  proposal_[4].target_counts = kNan;
  proposal_[2].torque_permille = 1700.0;
  expect_refused(GateCheck::kTorqueOutOfRange, 2, "two drives fail");
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
  live_ = false;
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
  live_ = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i)
    proposal_[i].target_counts = i % 2 == 0 ? kNan : 1e6 + 1e4;
  const GateResult result = judge();
  EXPECT_EQ(result.check, GateCheck::kPassed);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i)
    EXPECT_EQ(result.command[i].target_counts, 1000000);
}

TEST_F(Gate, ATargetFromBeforeThePowerIsNeverHeld) {
  live_ = false;
  previous_[0] = {kDisableVoltage, 123};  // as after start, with a drive that somebody else had enabled
  EXPECT_EQ(judge().command[0].target_counts, feedback_[0].position_counts);
}

TEST_F(Gate, EnablingIsBumpless) {
  // Tick by tick as a drive goes from Switched on to Operation enabled while its motor creeps by a few counts.
  live_ = false;
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
  live_ = false;
  goal_ = DriveGoal::kQuickStop;
  feedback_[1].statusword = kStatusFault;
  feedback_[2].statusword = kStatusQuickStop;
  const GateResult result = judge();
  EXPECT_EQ(result.command[0].controlword, kQuickStopCommand);
  EXPECT_EQ(result.command[1].controlword, kDisableVoltage);
  EXPECT_EQ(result.command[2].controlword, kQuickStopCommand);
}

TEST_F(Gate, ARefusalBecomesAFaultThatNamesDriveAndCheck) {
  EXPECT_EQ(gate_fault(judge(), 9).number, FaultNumber::kNone);
  proposal_[2].target_counts = kNan;
  const Fault fault = gate_fault(judge(), 9);
  EXPECT_EQ(fault.number, FaultNumber::kGateRefused);
  EXPECT_EQ(fault.index, 2);
  EXPECT_EQ(fault.detail, static_cast<std::uint16_t>(GateCheck::kTargetNotFinite));
  EXPECT_EQ(fault.tick, 9U);
  EXPECT_STREQ(gate_check_name(GateCheck::kTargetNotFinite), "target_not_finite");
  EXPECT_STREQ(gate_check_name(static_cast<GateCheck>(12)), "unknown");
}

TEST_F(Gate, TheGateIsPure) {
  proposal_[0].target_counts += 20.0;
  const GateResult first = judge();
  const GateResult second = judge();
  for (std::size_t i = 0; i < static_cast<std::size_t>(kMaxDrives); ++i) {
    EXPECT_EQ(first.command[i].target_counts, second.command[i].target_counts);
    EXPECT_EQ(first.command[i].controlword, second.command[i].controlword);
  }
}

}  // namespace
}  // namespace liana
