// The supervisor's table row by row: from every phase, with every severity, whatever the drives do.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <vector>

#include "firmware_like/safety/supervisor.hpp"
#include "tests/firmware_like/safety_bench.hpp"

namespace liana {
namespace {

using namespace safety_bench;

const WatchdogLimits kLimits = make_watchdog_limits(table());

struct Severity {
  const char* name;
  StopCategory category;
  std::uint8_t immediate;
};
struct Reaction {
  Phase from;
  std::array<Phase, 5> to;  // with no fault, hold, stop, immediate, off
};

TEST(SupervisorTable, EveryPhaseAnswersEverySeverityInTheSameTick) {
  using P = Phase;
  constexpr std::array<Severity, 5> kSeverities{{{"none", StopCategory::kNone, 0},
                                                 {"hold", StopCategory::kHold, 0},
                                                 {"stop", StopCategory::kStop, 0},
                                                 {"immediate", StopCategory::kStop, 1},
                                                 {"off", StopCategory::kOff, 1}}};
  const std::vector<Reaction> reactions{
      {P::kDisabled, {P::kDisabled, P::kFault, P::kFault, P::kFault, P::kFault}},
      {P::kSwitchingOn, {P::kPowering, P::kPowerDown, P::kPowerDown, P::kPowerDown, P::kPowerDown}},
      {P::kPowering, {P::kTensioning, P::kPowerDown, P::kPowerDown, P::kPowerDown, P::kPowerDown}},
      {P::kTensioning, {P::kEnabled, P::kBraking, P::kBraking, P::kQuickStop, P::kPowerDown}},
      {P::kEnabled, {P::kEnabled, P::kEnabled, P::kPathStop, P::kQuickStop, P::kPowerDown}},
      {P::kPathStop, {P::kPathStop, P::kPathStop, P::kPathStop, P::kQuickStop, P::kPowerDown}},
      {P::kBraking, {P::kBraking, P::kBraking, P::kBraking, P::kBraking, P::kPowerDown}},
      {P::kQuickStop, {P::kQuickStop, P::kQuickStop, P::kQuickStop, P::kQuickStop, P::kPowerDown}},
      {P::kPowerDown, {P::kPowerDown, P::kPowerDown, P::kPowerDown, P::kPowerDown, P::kPowerDown}},
      {P::kFault, {P::kFault, P::kFault, P::kFault, P::kFault, P::kFault}},
      {P::kResetting, {P::kResetting, P::kResetting, P::kResetting, P::kResetting, P::kResetting}},
  };
  ASSERT_EQ(reactions.size(), static_cast<std::size_t>(kPhaseCount));
  for (const Reaction& reaction : reactions) {
    for (std::size_t s = 0; s < kSeverities.size(); ++s) {
      SupervisorState state{reaction.from, 1, 0, 0, {}};
      FaultList faults{};
      faults.category = kSeverities[s].category;
      faults.immediate = kSeverities[s].immediate;
      supervise(kLimits, healthy(kStatusEnabled), {false, true, false, true}, 0, state, faults);
      EXPECT_EQ(state.phase, reaction.to[s]) << "phase " << static_cast<int>(reaction.from) << ", " << kSeverities[s].name;
    }
  }
}

TEST(SupervisorTable, AFaultIsNeverShownAsDisabledNotEvenForOneTick) {
  for (const Phase from : {Phase::kPowerDown, Phase::kResetting}) {
    SupervisorState state{from, 100, 0, 0, {}};
    FaultList faults{};
    latch(faults, {FaultNumber::kDriveMissing, 1, 0, 1});
    EXPECT_EQ(supervise(kLimits, healthy(kStatusDisabled), {false, true, true, true}, 1, state, faults).state, OperatingState::kFault);
  }
}

TEST(SupervisorTable, NoStateIsLeftWithoutEndWhateverTheDrivesDo) {
  // From every phase, with drives that never answer, a stop request ends in Disabled or Fault with disable voltage on the bus.
  for (std::int32_t phase = 0; phase < kPhaseCount; ++phase) {
    SupervisorState state{static_cast<Phase>(phase), 0, 0, 0, {}};
    FaultList faults{};
    Inputs inputs = healthy(kStatusEnabled, 0);
    const MotionStatus motion{false, true, false, false};
    std::uint32_t ticks = 0;
    const std::uint32_t bound = kPathStopBudgetTicks + kQuickStopBudgetTicks + kOffBudgetTicks + kResetBudgetTicks + 10;
    bool ended = false;
    for (; ticks < bound && !ended; ++ticks) {
      inputs.request = Request::kStop;
      const Orders orders = supervise(kLimits, inputs, motion, 0, state, faults);
      ended = orders.goal == DriveGoal::kDisabled && (orders.state == OperatingState::kDisabled || orders.state == OperatingState::kFault);
    }
    EXPECT_TRUE(ended) << "phase " << phase;
  }
}

TEST(SupervisorTable, MotionIsAllowedInNoPhaseButEnabledAndNeverWithAFault) {
  for (std::int32_t phase = 0; phase < kPhaseCount; ++phase) {
    for (const bool with_fault : {false, true}) {
      SupervisorState state{static_cast<Phase>(phase), 0, 0, 0, {}};
      FaultList faults{};
      if (with_fault) latch(faults, {FaultNumber::kCommandInvalid, -1, 0, 1});
      const Orders orders = supervise(kLimits, healthy(kStatusReady), {false, true, true, false}, 0, state, faults);
      EXPECT_EQ(orders.motion_allowed, static_cast<Phase>(phase) == Phase::kEnabled && !with_fault) << phase;
    }
  }
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
}  // namespace liana
