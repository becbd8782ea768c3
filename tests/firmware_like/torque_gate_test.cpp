// The gate over torque drives: every bound just inside and just outside, and what a refusal sends. req:A19 req:B20
#include <gtest/gtest.h>

#include "firmware_like/safety/gate.hpp"
#include "tests/firmware_like/extremes.hpp"

namespace liana {
namespace {

// One torque drive in the middle of its range and of a motion.
struct TorqueGate {
  TorqueGate() {
    limits.drive_count = 1;
    limits.drive[0] = {DriveMode::kCyclicTorque, -1000.0, 1000.0, 51, -1000.0, 1000.0, 2000.0, 50.0, 40.0, 0};
    proposal[0].mode = DriveMode::kCyclicTorque;
    proposal[0].torque_permille = 100.4;
    proposal[0].rate_counts_s = -500.4;
    previous[0] = {kEnableOperation, 0, 100, -500};
    feedback[0].statusword = 0x0237;
  }
  GateResult judge() const { return gate(limits, DriveGoal::kOperationEnabled, true, proposal, previous, feedback); }

  GateLimits limits{};
  DriveProposals proposal{};
  DriveCommands previous{};
  DriveFeedbacks feedback{};
};

TEST(TorqueGate, PassesTorqueAndRateRoundedWhatIsInsideAllBounds) {
  const GateResult result = TorqueGate().judge();
  EXPECT_EQ(result.check, GateCheck::kPassed);
  EXPECT_EQ(result.command[0].torque_permille, 100);
  EXPECT_EQ(result.command[0].rate_counts_s, -500);
  EXPECT_EQ(result.command[0].controlword, kEnableOperation);
}

TEST(TorqueGate, EveryBoundIsRefusedJustOutsideAndThenNothingIsAskedForButRest) {
  struct Row {
    const char* why;
    double torque_permille, rate_counts_s;
    std::int32_t position_counts, previous_rate;
    std::int16_t previous_permille;
    GateCheck check;
  };
  const Row rows[] = {
      {"most torque", 1000.0, 0, 0, 0, 990, GateCheck::kPassed},
      {"more torque", 1000.1, 0, 0, 0, 990, GateCheck::kTorqueOutOfRange},
      {"torque is no number", kNan, 0, 0, 0, 0, GateCheck::kTorqueNotFinite},
      {"most rate", 0, -2000.0, 0, -2000, 0, GateCheck::kPassed},
      {"more rate", 0, -2000.1, 0, -2000, 0, GateCheck::kRateOutOfRange},
      {"rate is no number", 0, kNan, 0, 0, 0, GateCheck::kRateNotFinite},
      {"rate changes by the most", 0, 50.0, 0, 0, 0, GateCheck::kPassed},
      {"rate changes by more", 0, 50.1, 0, 0, 0, GateCheck::kRateStepTooLarge},
      {"the largest torque change", -40.0, 0, 0, 0, 0, GateCheck::kPassed},
      {"torque changes by more", -40.1, 0, 0, 0, 0, GateCheck::kTorqueStepTooLarge},
      {"beyond its range, on outwards", 0, 1.0, 1001, 0, 0, GateCheck::kRateOutOfRange},
      {"beyond its range, back inside", 0, -1.0, 1001, 0, 0, GateCheck::kPassed},
      {"beyond its lower end, on outwards", 0, -1.0, -1001, 0, 0, GateCheck::kRateOutOfRange},
      {"beyond its lower end, back inside", 0, 1.0, -1001, 0, 0, GateCheck::kPassed},
      {"beyond its range, at rest", 0, 0, 1001, 0, 0, GateCheck::kPassed},
      {"beyond its lower end, at rest", 0, 0, -1001, 0, 0, GateCheck::kPassed},
      {"at the end of its range", 0, 1.0, 1000, 0, 0, GateCheck::kPassed},
      {"at its lower end", 0, -1.0, -1000, 0, 0, GateCheck::kPassed},
  };
  for (const Row& row : rows) {
    TorqueGate at;
    at.proposal[0].torque_permille = row.torque_permille;
    at.proposal[0].rate_counts_s = row.rate_counts_s;
    at.feedback[0].position_counts = row.position_counts;
    at.previous[0] = {kEnableOperation, 0, row.previous_permille, row.previous_rate};
    const GateResult result = at.judge();
    EXPECT_EQ(result.check, row.check) << row.why;
    if (row.check == GateCheck::kPassed) continue;
    EXPECT_EQ(result.command[0].torque_permille, 0) << row.why;
    EXPECT_EQ(result.command[0].rate_counts_s, 0) << row.why;
  }
}

TEST(TorqueGate, APositionModeForATorqueDriveIsRefusedAndTheOtherWayRound) {
  TorqueGate at;
  at.proposal[0].mode = DriveMode::kCyclicPosition;
  EXPECT_EQ(at.judge().check, GateCheck::kModeNotAllowed);
  at.limits.drive[0].mode = DriveMode::kCyclicPosition;
  const GateResult passed = at.judge();
  EXPECT_EQ(passed.check, GateCheck::kPassed);
  EXPECT_EQ(passed.command[0].torque_permille, 0) << "a position drive is told no torque";
}

}  // namespace
}  // namespace liana
