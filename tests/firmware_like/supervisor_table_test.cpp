// The supervisor's table row by row: from every phase, with every severity, whatever the drives do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "firmware_like/safety/supervisor.hpp"
#include "tests/firmware_like/safety_bench.hpp"

namespace liana::cable {
namespace {

using namespace safety_bench;

const LinkLimits kLimits = make_link_limits(table());

struct Severity {
  StopCategory category;
  std::uint8_t immediate;
};

// Names of the phases in docs/explanation/fault-detection.md, in the order of Phase.
const std::array<std::string, kPhaseCount> kPhaseNames{"disabled",   "switching on", "powering", "tensioning",
                                                       "enabled",    "path stop",    "braking",  "quick stop",
                                                       "power down", "fault",        "resetting"};

// The rows of the page's table that begin with a phase: that phase and what it leads to, by rising severity.
std::vector<std::vector<Phase>> documented_reactions() {
  std::ifstream page(LIANA_DOCS_DIR "/explanation/fault-detection.md");
  std::vector<std::vector<Phase>> rows;
  for (std::string line; std::getline(page, line);) {
    std::vector<Phase> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, '|');) {
      const auto* const name =
          std::find(kPhaseNames.begin(), kPhaseNames.end(), cell.substr(cell.empty() ? 0 : 1, cell.size() - 2));
      if (name != kPhaseNames.end()) row.push_back(static_cast<Phase>(name - kPhaseNames.begin()));
    }
    if (row.size() > 1) rows.push_back(row);
  }
  return rows;
}

TEST(SupervisorTable, EveryPhaseAnswersEverySeverityInTheSameTickAsThePageSays) {
  // No fault, hold, stop, stop at once, off at once.
  constexpr std::array<Severity, 5> kSeverities{{{StopCategory::kNone, 0},
                                                 {StopCategory::kHold, 0},
                                                 {StopCategory::kStop, 0},
                                                 {StopCategory::kStop, 1},
                                                 {StopCategory::kOff, 1}}};
  const std::vector<std::vector<Phase>> rows = documented_reactions();
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kPhaseCount));
  std::set<Phase> documented;
  for (const std::vector<Phase>& row : rows) {
    ASSERT_EQ(row.size(), kSeverities.size() + 1) << kPhaseNames[static_cast<std::size_t>(row[0])];
    documented.insert(row[0]);
    for (std::size_t s = 0; s < kSeverities.size(); ++s) {
      SupervisorState state{row[0], 1, 0, 0, {}};
      FaultList faults{};
      faults.category = kSeverities[s].category;
      faults.immediate = kSeverities[s].immediate;
      supervise(kLimits, healthy(kStatusEnabled), {true, false, true}, CommandKind::kNone, 0, state, faults);
      EXPECT_EQ(state.phase, row[s + 1]) << kPhaseNames[static_cast<std::size_t>(row[0])] << ", severity " << s
                                         << " leads to " << kPhaseNames[static_cast<std::size_t>(state.phase)];
    }
  }
  EXPECT_EQ(documented.size(), rows.size());
}

TEST(SupervisorTable, AFaultIsNeverShownAsDisabledNotEvenForOneTick) {
  for (const Phase from : {Phase::kPowerDown, Phase::kResetting}) {
    SupervisorState state{from, 100, 0, 0, {}};
    FaultList faults{};
    latch(faults, {FaultNumber::kDriveMissing, 1, 0, 1});
    EXPECT_EQ(
        supervise(kLimits, healthy(kStatusDisabled), {true, true, true}, CommandKind::kNone, 1, state, faults).state,
        OperatingState::kFault);
  }
}

TEST(SupervisorTable, NoStateIsLeftWithoutEndWhateverTheDrivesDo) {
  // From every phase, with drives that never answer, a stop request ends in Disabled or Fault with disable voltage on
  // the bus.
  for (std::int32_t phase = 0; phase < kPhaseCount; ++phase) {
    SupervisorState state{static_cast<Phase>(phase), 0, 0, 0, {}};
    FaultList faults{};
    CycleInputs inputs = healthy(kStatusEnabled, 0);
    const ArmStatus arm{true, false, false};
    std::uint32_t ticks = 0;
    const std::uint32_t bound =
        kTimeout_s.path_stop + kTimeout_s.quick_stop + kTimeout_s.off_budget + kTimeout_s.reset_budget + 10;
    bool ended = false;
    for (; ticks < bound && !ended; ++ticks) {
      inputs.request = Request::kStop;
      const Orders orders = supervise(kLimits, inputs, arm, CommandKind::kNone, 0, state, faults);
      ended = orders.goal == DriveGoal::kDisabled &&
              (orders.state == OperatingState::kDisabled || orders.state == OperatingState::kFault);
    }
    EXPECT_TRUE(ended) << "phase " << phase;
  }
}

TEST(SupervisorTable, OnlyAnEnabledArmMovesAndWithAFaultOnlyBackAsTheFaultsTableSays) {
  for (std::int32_t phase = 0; phase < kPhaseCount; ++phase) {
    for (const FaultInfo& info : all_faults()) {
      SupervisorState state{static_cast<Phase>(phase), 0, 0, 0, {}};
      FaultList faults{};
      latch(faults, {info.number, 1, 0, 1});
      const Orders orders =
          supervise(kLimits, healthy(kStatusReady), {true, true, false}, CommandKind::kNone, 0, state, faults);
      const bool enabled = static_cast<Phase>(phase) == Phase::kEnabled;
      const MayMove by_fault = info.number == FaultNumber::kNone ? MayMove::kEverything
                               : info.retract                    ? MayMove::kRetract
                                                                 : MayMove::kNothing;
      EXPECT_EQ(orders.may_move, enabled ? by_fault : MayMove::kNothing) << phase << " " << info.name;
    }
  }
}

// req:C2
TEST(SupervisorTable, NothingMovesWithAFaultWhileADriveIsNotHeardOrTheArmNotHomed) {
  const auto ordered = [](void (*spoil)(CycleInputs&, ArmStatus&)) {
    SupervisorState state{Phase::kEnabled, 0, 0, 0, {}};
    FaultList faults{};
    latch(faults, {FaultNumber::kCableSlip, 1, 0, 1});
    CycleInputs inputs = healthy(kStatusEnabled);
    ArmStatus arm{true, true, true};
    spoil(inputs, arm);
    return supervise(kLimits, inputs, arm, CommandKind::kRetract, 0, state, faults).may_move;
  };
  EXPECT_EQ(ordered([](CycleInputs&, ArmStatus&) {}), MayMove::kRetract);
  EXPECT_EQ(ordered([](CycleInputs&, ArmStatus& arm) { arm.homed = false; }), MayMove::kNothing);
  EXPECT_EQ(ordered([](CycleInputs& in, ArmStatus&) { in.drive[2].feedback_age_ticks = 3; }), MayMove::kNothing);
  EXPECT_EQ(ordered([](CycleInputs& in, ArmStatus&) { in.drive[2].heartbeat_age_ticks = 76; }), MayMove::kNothing);
  EXPECT_EQ(ordered([](CycleInputs& in, ArmStatus&) { in.drive[2].operational = 0; }), MayMove::kNothing);
  EXPECT_EQ(ordered([](CycleInputs& in, ArmStatus&) { in.lost_bus_mask = 1; }), MayMove::kNothing);
}

TEST(SupervisorTable, WhatMayMoveIsAskedOfTheKindOfCommand) {
  // In the order of CommandKind: t tip, j joint, f force, - no goal.
  const std::string kinds = "-tj--jff";
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const auto kind = static_cast<CommandKind>(i);
    EXPECT_EQ(is_joint(kind), kinds[i] == 'j') << i;
    EXPECT_EQ(is_force(kind), kinds[i] == 'f') << i;
    EXPECT_FALSE(is_let_move(MayMove::kNothing, kind));
    EXPECT_EQ(is_let_move(MayMove::kRetract, kind), kind == CommandKind::kRetract);
    EXPECT_EQ(is_let_move(MayMove::kEverything, kind), kinds[i] != '-') << i;
  }
}

TEST(SupervisorTable, AnArmWithoutACableOnlyRetractsAndNothingMovesBesideFaultsThatWereDropped) {
  SupervisorState state{Phase::kEnabled, 0, 0, 0, {}};
  FaultList faults{};
  ArmStatus arm{true, true, true};
  const auto ordered = [&] {
    return supervise(kLimits, healthy(kStatusEnabled), arm, CommandKind::kNone, 0, state, faults).may_move;
  };
  EXPECT_EQ(ordered(), MayMove::kEverything);
  arm.recovers = true;
  EXPECT_EQ(ordered(), MayMove::kRetract);
  latch(faults, {FaultNumber::kCableSlip, 1, 0, 1});
  EXPECT_EQ(ordered(), MayMove::kRetract);
  faults.dropped = 1;
  EXPECT_EQ(ordered(), MayMove::kNothing);
}

TEST(Conditions, EveryBitHasItsOwnName) {
  std::set<std::string> names;
  for (std::uint32_t bit = kBusesUp; bit <= kFaultPersists; bit <<= 1U) names.insert(condition_name(bit));
  EXPECT_EQ(names.size(), 22U);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(condition_name(kBusesUp | kHomed), "unknown");
  EXPECT_STREQ(condition_name(kFaultPersists << 1U), "unknown");
}

}  // namespace
}  // namespace liana::cable
