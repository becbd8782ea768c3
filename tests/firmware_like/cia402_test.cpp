#include "firmware_like/drive/cia402.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "firmware_like/drive/ideal_drive.hpp"

namespace liana {
namespace {

// The statusword table of CiA 402 in another form than the code's: bit by bit, as text. Bits 6 5 3 2 1 0, 'x' = either.
struct Pattern {
  DriveState state;
  const char* bits;
};
constexpr std::array<Pattern, 8> kPatterns{{
    {DriveState::kNotReadyToSwitchOn, "0x0000"},
    {DriveState::kSwitchOnDisabled, "1x0000"},
    {DriveState::kReadyToSwitchOn, "010001"},
    {DriveState::kSwitchedOn, "010011"},
    {DriveState::kOperationEnabled, "010111"},
    {DriveState::kQuickStopActive, "000111"},
    {DriveState::kFaultReactionActive, "0x1111"},
    {DriveState::kFault, "0x1000"},
}};

bool matches(std::uint32_t word, const char* bits) {
  constexpr std::array<std::uint32_t, 6> kBitNumbers{6, 5, 3, 2, 1, 0};
  for (std::size_t i = 0; i < kBitNumbers.size(); ++i) {
    const char bit = ((word >> kBitNumbers[i]) & 1U) != 0 ? '1' : '0';
    if (bits[i] != 'x' && bits[i] != bit) return false;
  }
  return true;
}

TEST(Cia402, EveryOneOfThe65536StatuswordsDecodesToExactlyOneStateOrUnknown) {
  std::map<DriveState, int> seen;
  for (std::uint32_t word = 0; word <= 0xFFFF; ++word) {
    DriveState expected = DriveState::kUnknown;
    int matching = 0;
    for (const Pattern& pattern : kPatterns) {
      if (!matches(word, pattern.bits)) continue;
      expected = pattern.state;
      ++matching;
    }
    ASSERT_LE(matching, 1) << "statusword " << word;
    ASSERT_EQ(decode(static_cast<std::uint16_t>(word)), expected) << "statusword " << word;
    ++seen[expected];
  }
  EXPECT_EQ(seen.size(), 9U);
  EXPECT_EQ(seen[DriveState::kOperationEnabled], 1024);  // ten free bits
  EXPECT_EQ(seen[DriveState::kFault], 2048);             // eleven
}

// A drive of the standard: what a controlword does in a state. Bits are read as the command coding of CiA 402 prints
// them.
struct Drive {
  DriveState state = DriveState::kNotReadyToSwitchOn;
  std::uint16_t last_word = 0;
  int transition = 0;  // of the last step; 0 = none
};

void move(Drive& drive, DriveState to, int transition) {
  drive.state = to;
  drive.transition = transition;
}

void step(Drive& drive, std::uint16_t word) {
  const bool disable_voltage = (word & 0x0002) == 0;
  const bool quick_stop = (word & 0x0006) == 0x0002;
  const bool shutdown = (word & 0x0007) == 0x0006;
  const bool switch_on = (word & 0x000F) == 0x0007;
  const bool enable = (word & 0x000F) == 0x000F;
  const bool reset_edge = (word & 0x0080) != 0 && (drive.last_word & 0x0080) == 0;
  drive.last_word = word;
  drive.transition = 0;
  switch (drive.state) {
    case DriveState::kNotReadyToSwitchOn:
      return move(drive, DriveState::kSwitchOnDisabled, 1);
    case DriveState::kSwitchOnDisabled:
      return shutdown ? move(drive, DriveState::kReadyToSwitchOn, 2) : void();
    case DriveState::kReadyToSwitchOn:
      if (disable_voltage || quick_stop) return move(drive, DriveState::kSwitchOnDisabled, 7);
      return switch_on || enable ? move(drive, DriveState::kSwitchedOn, 3) : void();
    case DriveState::kSwitchedOn:
      if (disable_voltage || quick_stop) return move(drive, DriveState::kSwitchOnDisabled, 10);
      if (shutdown) return move(drive, DriveState::kReadyToSwitchOn, 6);
      return enable ? move(drive, DriveState::kOperationEnabled, 4) : void();
    case DriveState::kOperationEnabled:
      if (disable_voltage) return move(drive, DriveState::kSwitchOnDisabled, 9);
      if (quick_stop) return move(drive, DriveState::kQuickStopActive, 11);
      if (shutdown) return move(drive, DriveState::kReadyToSwitchOn, 8);
      return switch_on ? move(drive, DriveState::kSwitchedOn, 5) : void();
    case DriveState::kQuickStopActive:
      if (disable_voltage) return move(drive, DriveState::kSwitchOnDisabled, 12);
      return enable ? move(drive, DriveState::kOperationEnabled, 16) : void();
    case DriveState::kFaultReactionActive:
      return move(drive, DriveState::kFault, 14);
    case DriveState::kFault:
      return reset_edge ? move(drive, DriveState::kSwitchOnDisabled, 15) : void();
    case DriveState::kUnknown:
      return;
  }
}

std::vector<int> transitions_towards(DriveState from, DriveGoal goal, int steps) {
  Drive drive{from, 0, 0};
  std::uint16_t word = 0;
  std::vector<int> taken;
  for (int i = 0; i < steps; ++i) {
    word = controlword_for(drive.state, goal, word);
    step(drive, word);
    if (drive.transition != 0) taken.push_back(drive.transition);
  }
  return taken;
}

struct Journey {
  DriveState from;
  DriveGoal goal;
  std::vector<int> transitions;
  const char* why;
};

TEST(Cia402, EveryGoalIsReachedThroughTheTransitionsOfTheStandard) {
  using S = DriveState;
  using G = DriveGoal;
  const std::vector<Journey> journeys{
      {S::kNotReadyToSwitchOn, G::kOperationEnabled, {1, 2, 3, 4}, "from power-up"},
      {S::kSwitchOnDisabled, G::kSwitchedOn, {2, 3}, "brakes stay closed"},
      {S::kReadyToSwitchOn, G::kOperationEnabled, {3, 4}, "half way"},
      {S::kSwitchedOn, G::kOperationEnabled, {4}, "last step"},
      {S::kSwitchedOn, G::kSwitchedOn, {}, "stays"},
      {S::kOperationEnabled, G::kOperationEnabled, {}, "stays"},
      {S::kOperationEnabled, G::kSwitchedOn, {5}, "brakes close, power stays"},
      {S::kReadyToSwitchOn, G::kDisabled, {7}, "disable voltage"},
      {S::kSwitchedOn, G::kDisabled, {10}, "disable voltage"},
      {S::kOperationEnabled, G::kDisabled, {9}, "torque off at once"},
      {S::kOperationEnabled, G::kQuickStop, {11}, "the drive's own ramp"},
      {S::kReadyToSwitchOn, G::kQuickStop, {7}, "nothing to stop"},
      {S::kSwitchedOn, G::kQuickStop, {10}, "nothing to stop"},
      {S::kQuickStopActive, G::kQuickStop, {}, "waits for the drive"},
      {S::kQuickStopActive, G::kOperationEnabled, {}, "16 is never used"},
      {S::kQuickStopActive, G::kSwitchedOn, {}, "16 is never used"},
      {S::kQuickStopActive, G::kDisabled, {12}, "disable voltage"},
      {S::kFaultReactionActive, G::kOperationEnabled, {14}, "no reset without being asked"},
      {S::kFault, G::kOperationEnabled, {}, "no reset without being asked"},
      {S::kFault, G::kDisabled, {}, "no reset without being asked"},
      {S::kFault, G::kFaultReset, {15}, "rising edge"},
      {S::kFaultReactionActive, G::kFaultReset, {14, 15}, "after the reaction"},
      {S::kOperationEnabled, G::kFaultReset, {9}, "a reset never keeps power"},
      {S::kSwitchOnDisabled, G::kFaultReset, {}, "stays off"},
  };
  for (const Journey& journey : journeys) {
    EXPECT_EQ(transitions_towards(journey.from, journey.goal, 8), journey.transitions)
        << drive_state_name(journey.from) << " towards goal " << static_cast<int>(journey.goal) << ": " << journey.why;
  }
}

TEST(Cia402, FaultResetMakesARisingEdgeEverySecondTickAndNeverHoldsTheBit) {
  std::uint16_t word = 0x0080;  // bit already set before the fault: no edge yet
  std::vector<std::uint16_t> sent;
  for (int i = 0; i < 4; ++i) {
    word = controlword_for(DriveState::kFault, DriveGoal::kFaultReset, word);
    sent.push_back(word);
  }
  EXPECT_EQ(controlword_for(DriveState::kReadyToSwitchOn, DriveGoal::kSwitchedOn, 0x0080), kSwitchOn)
      << "an old edge spends no other word";
  EXPECT_EQ(sent, (std::vector<std::uint16_t>{0x0000, 0x0080, 0x0000, 0x0080}));
}

TEST(Cia402, OnlyTheFaultResetGoalInFaultEverSetsTheResetBit) {
  for (std::int32_t state = 0; state < kDriveStateCount; ++state) {
    for (std::int32_t goal = 0; goal < kDriveGoalCount; ++goal) {
      const std::uint16_t word = controlword_for(static_cast<DriveState>(state), static_cast<DriveGoal>(goal), 0);
      const bool may = static_cast<DriveState>(state) == DriveState::kFault &&
                       static_cast<DriveGoal>(goal) == DriveGoal::kFaultReset;
      EXPECT_EQ((word & 0x0080) != 0, may) << state << " " << goal;
    }
  }
}

TEST(Cia402, EnableOperationIsSentOnlyFromSwitchedOnOrOperationEnabled) {
  for (std::int32_t state = 0; state < kDriveStateCount; ++state) {
    for (std::int32_t goal = 0; goal < kDriveGoalCount; ++goal) {
      const auto from = static_cast<DriveState>(state);
      const bool enables = controlword_for(from, static_cast<DriveGoal>(goal), 0) == kEnableOperation;
      const bool may = static_cast<DriveGoal>(goal) == DriveGoal::kOperationEnabled &&
                       (from == DriveState::kSwitchedOn || from == DriveState::kOperationEnabled);
      EXPECT_EQ(enables, may) << state << " " << goal;
    }
  }
}

TEST(Cia402, AStateOrGoalThatDoesNotExistIsAnsweredByDisableVoltage) {
  EXPECT_EQ(controlword_for(static_cast<DriveState>(200), DriveGoal::kOperationEnabled, 0), kDisableVoltage);
  EXPECT_EQ(controlword_for(DriveState::kOperationEnabled, static_cast<DriveGoal>(200), 0), kDisableVoltage);
  EXPECT_EQ(controlword_for(DriveState::kOperationEnabled, static_cast<DriveGoal>(kDriveGoalCount), 0),
            kDisableVoltage);
  EXPECT_STREQ(drive_state_name(static_cast<DriveState>(kDriveStateCount)), "unknown");
  EXPECT_STREQ(drive_state_name(static_cast<DriveState>(200)), "unknown");
}

TEST(Cia402, EveryStateHasItsOwnNameAndAtMostOneOfTorqueAndOff) {
  std::set<std::string> names;
  for (std::int32_t state = 0; state < kDriveStateCount; ++state) {
    names.insert(drive_state_name(static_cast<DriveState>(state)));
    EXPECT_FALSE(has_torque(static_cast<DriveState>(state)) && is_off(static_cast<DriveState>(state)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kDriveStateCount));
}

TEST(Cia402, TorqueAndOffAreThoseStatesAndNoOthers) {
  // In the order of the figure, from kUnknown: t torque, o off, - neither.
  const std::string expected = "-ooo-ttto";
  for (std::int32_t i = 0; i < kDriveStateCount; ++i) {
    const auto state = static_cast<DriveState>(i);
    EXPECT_EQ(has_torque(state), expected[static_cast<std::size_t>(i)] == 't') << drive_state_name(state);
    EXPECT_EQ(is_off(state), expected[static_cast<std::size_t>(i)] == 'o') << drive_state_name(state);
  }
}

// A drive as the twin imagines it, answering what it is told a tick later.
TEST(IdealDrive, TakesTargetAndTorqueWhileItIsEnabledAndKeepsBothOtherwise) {
  const DriveFeedback last{0x1637, 30, 1000, 0, 9, 9, 0x8130, 1};
  for (const std::uint16_t word : {kEnableOperation, kSwitchOn, kShutdown, kQuickStopCommand, kDisableVoltage}) {
    const DriveFeedback next = ideal_feedback(last, {word, 1500}, 80);
    const bool enabled = word == kEnableOperation;
    EXPECT_EQ(next.position_counts, enabled ? 1500 : 1000) << word;
    EXPECT_EQ(next.torque_permille, enabled ? 80 : 30) << word;
    EXPECT_EQ(next.statusword == last.statusword, enabled) << "a drive that is there keeps its word";
    EXPECT_EQ(next.feedback_age_ticks, 1);
    EXPECT_EQ(next.heartbeat_age_ticks, 0);
    EXPECT_EQ(next.emergency_code, 0);
  }
  EXPECT_EQ(ideal_feedback({0x0233}, {kEnableOperation, 7}, 0).statusword, 0x1237) << "from Switched on";
  EXPECT_EQ(statusword_after(kSwitchOn, 0x0633), 0x0633) << "there already";
}

TEST(IdealDrive, ATorqueDriveMovesAsItsTargetDoesAndCatchesUpByATwentieth) {
  struct Row {
    std::int32_t position, target_before, target, next;
  };
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  for (const Row& row : {Row{1000, 1400, 1450, 1070}, Row{1000, 600, 550, 930}, Row{1000, 1019, 1019, 1000},
                         Row{1000, 1020, 1020, 1001}, Row{kMost, 0, kMost, kMost}, Row{kLeast, 0, kLeast, kLeast}}) {
    DriveFeedback last{0x0237};
    last.position_counts = row.position;
    EXPECT_EQ(ideal_torque_feedback(last, {kEnableOperation, row.target}, row.target_before, 0).position_counts,
              row.next);
    EXPECT_EQ(ideal_torque_feedback(last, {kSwitchOn, row.target}, row.target_before, 0).position_counts, row.position);
  }
}

}  // namespace
}  // namespace liana
