#include "firmware_like/safety/supervisor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <string>
#include <utility>
#include <vector>

#include "firmware_like/safety/gate.hpp"
#include "tests/firmware_like/safety_bench.hpp"

namespace liana::cable {
namespace {

using namespace safety_bench;

constexpr std::size_t kNoDrive = 99;

// Supervisor, watchdogs and gate joined as in a tick, on drives that follow controlwords one tick later.
class Operation : public ::testing::Test {
 protected:
  // One tick; drives answer the controlwords in the next one.
  Orders tick(Request request = Request::kNone) {
    ++inputs_.tick;
    inputs_.request = request;
    const std::int32_t active = watchdogs_.run(watch_scope(state_), inputs_, sent_, tension_N_, tension_N_, faults_);
    orders_ = supervise(limits_, inputs_, arm_, in_force_, active, state_, faults_);
    sent_ = gate(gate_limits_, orders_.goal, orders_.live_targets, proposal_, sent_, inputs_.drive).command;
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      if (i != stuck_drive_) inputs_.drive[i].statusword = answer(inputs_.drive[i].statusword, sent_[i].controlword);
    }
    return orders_;
  }

  // Ticks until the state is reached; the number of ticks, or `most` + 1.
  int ticks_until(OperatingState wanted, int most) {
    for (int count = 1; count <= most; ++count) {
      if (tick().state == wanted) return count;
    }
    return most + 1;
  }

  void enable() {
    tick(Request::kEnable);
    ASSERT_LE(ticks_until(OperatingState::kEnabled, 20), 20);
    ASSERT_EQ(orders_.may_move, MayMove::kEverything);
  }

  static std::uint16_t answer(std::uint16_t status, std::uint16_t word) {
    if (status == kStatusFault) return (word & 0x0080) != 0 ? kStatusDisabled : status;
    if ((word & 0x0002) == 0) return kStatusDisabled;
    if ((word & 0x0006) == 0x0002) return status == kStatusEnabled ? kStatusQuickStop : kStatusDisabled;
    if (status == kStatusQuickStop) return kStatusDisabled;
    if (word == 0x0006) return kStatusReady;
    if (word == 0x0007) return kStatusSwitchedOn;
    return status == kStatusSwitchedOn || status == kStatusEnabled ? kStatusEnabled : status;
  }

  bool any_drive_shows(std::uint16_t status) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
      if (inputs_.drive[i].statusword == status) return true;
    }
    return false;
  }

  RobotParams robot_ = table();
  LinkLimits limits_ = make_link_limits(robot_);
  GateLimits gate_limits_ = make_gate_limits(robot_, zero_payout_m());
  Watchdogs watchdogs_{};
  SupervisorState state_{};
  FaultList faults_{};
  CycleInputs inputs_ = healthy(kStatusDisabled, 0);
  ArmStatus arm_{true, true, true};
  CommandKind in_force_ = CommandKind::kNone;
  CableVector tension_N_ = [] {
    CableVector tension{};
    tension.fill(40.0);
    return tension;
  }();
  DriveProposals proposal_ = [] {
    DriveProposals standing{};
    standing.fill({DriveMode::kCyclicPosition, 1000000.0, 66.7});
    return standing;
  }();
  DriveCommands sent_{};
  std::size_t stuck_drive_ = kNoDrive;
  Orders orders_{};
};

TEST_F(Operation, EnablingGoesThroughSwitchedOnAndTheRampBeforeMotionIsAllowed) {
  arm_.prepared = false;
  EXPECT_EQ(tick().state, OperatingState::kDisabled);
  EXPECT_EQ(tick(Request::kEnable).state, OperatingState::kEnabling);
  EXPECT_EQ(orders_.goal, DriveGoal::kSwitchedOn);
  EXPECT_FALSE(orders_.live_targets);
  for (int i = 0; i < 20; ++i) tick();
  EXPECT_TRUE(orders_.preparing);
  EXPECT_TRUE(orders_.live_targets);
  EXPECT_EQ(orders_.may_move, MayMove::kNothing);
  EXPECT_EQ(orders_.state, OperatingState::kEnabling);
  arm_.prepared = true;
  EXPECT_EQ(tick().state, OperatingState::kEnabled);
  EXPECT_EQ(orders_.may_move, MayMove::kEverything);
  EXPECT_FALSE(orders_.preparing);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(Operation, NoBrakeOpensBeforeEveryDriveIsSwitchedOn) {
  inputs_.drive[4].statusword = kStatusReady;
  stuck_drive_ = 4;
  tick(Request::kEnable);
  for (int i = 0; i < 100; ++i) {
    tick();
    EXPECT_FALSE(any_drive_shows(kStatusEnabled));
  }
}

TEST_F(Operation, OneDriveThatDoesNotEnableAbortsAllWithinTheBudgetAndIsNamed) {
  const std::pair<std::int16_t, std::uint16_t> cases[] = {
      {0, kStatusDisabled}, {4, kStatusReady}, {kDrives - 1, kStatusSwitchedOn}};
  for (const auto& [drive, status] : cases) {
    state_ = SupervisorState{};
    faults_ = FaultList{};
    inputs_ = healthy(kStatusDisabled, 0);
    stuck_drive_ = static_cast<std::size_t>(drive);
    inputs_.drive[stuck_drive_].statusword = status;
    tick(Request::kEnable);
    const int limit = static_cast<int>(2 * kTimeout_s.powering);
    EXPECT_LE(ticks_until(OperatingState::kStopping, limit), limit);
    EXPECT_TRUE(has(faults_, FaultNumber::kDriveEnableTimeout, drive));
    EXPECT_EQ(faults_.fault[0].detail, status);
    EXPECT_EQ(faults_.count, 1);
    stuck_drive_ = kNoDrive;
    EXPECT_LE(ticks_until(OperatingState::kFault, 20), 20);
    EXPECT_FALSE(any_drive_shows(kStatusEnabled));
  }
}

TEST(PatienceOfTheSupervisor, IsTheSameInSecondsAtEveryRate) {
  for (const double rate_hz : {200.0, 250.0, 500.0}) {
    const Patience ticks = patience(1.0 / rate_hz);
    EXPECT_EQ(ticks.powering, rate_hz) << "three transitions of 0.3 s, of which two are one step";
    EXPECT_EQ(ticks.preparing, 60 * rate_hz);
    EXPECT_EQ(ticks.rest, std::lround(0.1 * rate_hz));
    EXPECT_EQ(ticks.persist, 5 * rate_hz);
    EXPECT_EQ(ticks.path_stop, 4 * rate_hz);
    EXPECT_EQ(ticks.quick_stop, std::lround(0.5 * rate_hz));
    EXPECT_EQ(ticks.off_budget, rate_hz);
    EXPECT_EQ(ticks.reset_budget, rate_hz);
  }
  EXPECT_EQ(ticks_in(0.0, 1.0), 1U) << "at least one";
  EXPECT_EQ(ticks_in(2.48, 1.0), 2U) << "the nearest whole tick";
  EXPECT_EQ(ticks_in(2.52, 1.0), 3U);
}

TEST_F(Operation, APretensionRampThatNeverEndsIsATimeout) {
  arm_.prepared = false;
  tick(Request::kEnable);
  const int limit = static_cast<int>(kTimeout_s.preparing) + 100;
  EXPECT_LE(ticks_until(OperatingState::kFault, limit), limit);
  EXPECT_TRUE(has(faults_, FaultNumber::kDriveEnableTimeout, -1));
}

TEST_F(Operation, ACableThatTakesNoTensionIsNamedWithItsDriveTheFirstAndTheLast) {
  for (const int slack : {0, kDrives - 1, -1}) {
    state_ = SupervisorState{Phase::kPreparing, kTimeout_s.preparing, 0, 0, {}};
    faults_ = {};
    arm_.prepared = false;
    arm_.slack = static_cast<std::int16_t>(slack);
    for (std::int16_t i = 0; i < kDrives; ++i)
      inputs_.drive[static_cast<std::size_t>(i)].statusword = static_cast<std::uint16_t>(kStatusEnabled + (i << 8));
    tick();
    ASSERT_EQ(faults_.count, 1);
    EXPECT_EQ(faults_.fault[0].index, slack);
    EXPECT_EQ(faults_.fault[0].detail, slack < 0 ? 0 : kStatusEnabled + (slack << 8)) << "its statusword";
  }
}

TEST_F(Operation, AnArmThatIsPreparedInTheLastTickOfItsTimeIsInTime) {
  state_ = SupervisorState{Phase::kPreparing, kTimeout_s.preparing, 0, 0, {}};
  inputs_ = healthy(kStatusEnabled);
  EXPECT_EQ(tick().state, OperatingState::kEnabled);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(Operation, SlackIsLookedForFromTheEndOfTheRampToTheBrakes) {
  for (std::int32_t i = 0; i < kPhaseCount; ++i) {
    SupervisorState state;
    state.phase = static_cast<Phase>(i);
    const WatchScope scope = watch_scope(state);
    const bool moves = state.phase == Phase::kEnabled || state.phase == Phase::kPathStop;
    EXPECT_EQ(scope.prepared, moves) << i;
    EXPECT_EQ(scope.powered, moves || state.phase == Phase::kPreparing) << i;
  }
}

TEST_F(Operation, AgesAtTheirBoundsDoNotKeepTheArmFromEnabling) {
  inputs_.drive[0].feedback_age_ticks = inputs_.drive[kDrives - 1].feedback_age_ticks = 2;
  inputs_.drive[0].heartbeat_age_ticks = inputs_.drive[kDrives - 1].heartbeat_age_ticks = 75;
  EXPECT_EQ(tick(Request::kEnable).state, OperatingState::kEnabling);
}

struct Blocker {
  std::uint32_t missing;
  void (*apply)(CycleInputs&, ArmStatus&, FaultList&);
};

// req:C2
TEST_F(Operation, EnablingIsRefusedAndSaysWhyWhenAnyConditionIsMissing) {
  const std::vector<Blocker> blockers{
      {kBusesUp, [](CycleInputs& in, ArmStatus&, FaultList&) { in.lost_bus_mask = 1; }},
      {kDrivesFresh, [](CycleInputs& in, ArmStatus&, FaultList&) { in.drive[5].feedback_age_ticks = 3; }},
      {kDrivesFresh, [](CycleInputs& in, ArmStatus&, FaultList&) { in.drive[5].heartbeat_age_ticks = 76; }},
      {kDrivesOperational, [](CycleInputs& in, ArmStatus&, FaultList&) { in.drive[0].operational = 0; }},
      {kNoDriveInFault, [](CycleInputs& in, ArmStatus&, FaultList&) { in.drive[2].statusword = kStatusFault; }},
      {kHomed, [](CycleInputs&, ArmStatus& motion, FaultList&) { motion.homed = false; }},
      {kNoFault,
       [](CycleInputs&, ArmStatus&, FaultList& faults) {
         latch(faults, {FaultNumber::kCommandInvalid, -1, 0, 0});
       }},
  };
  for (const Blocker& blocker : blockers) {
    CycleInputs inputs = healthy(kStatusDisabled);
    ArmStatus motion = arm_;
    SupervisorState state{};
    FaultList faults{};
    blocker.apply(inputs, motion, faults);
    inputs.request = Request::kEnable;
    const Orders orders = supervise(limits_, inputs, motion, CommandKind::kNone, 0, state, faults);
    EXPECT_NE(orders.state, OperatingState::kEnabling) << condition_name(blocker.missing);
    EXPECT_EQ(orders.goal, DriveGoal::kDisabled);
    EXPECT_EQ(orders.enable_missing, blocker.missing) << condition_name(blocker.missing);
  }
}

TEST_F(Operation, DisableStopsAlongThePathThenBrakesThenPowersDown) {
  enable();
  arm_.at_rest = false;
  EXPECT_EQ(tick(Request::kDisable).state, OperatingState::kStopping);
  EXPECT_TRUE(orders_.live_targets);
  EXPECT_EQ(orders_.may_move, MayMove::kNothing);
  EXPECT_EQ(orders_.stop_category, StopCategory::kStop);
  for (int i = 0; i < 100; ++i) tick();
  EXPECT_EQ(orders_.goal, DriveGoal::kOperationEnabled) << "still decelerating";
  arm_.at_rest = true;
  for (std::uint32_t i = 1; i < kTimeout_s.rest; ++i) EXPECT_EQ(tick().goal, DriveGoal::kOperationEnabled);
  for (std::uint32_t i = 0; i < kTimeout_s.braking; ++i) EXPECT_EQ(tick().goal, DriveGoal::kSwitchedOn);
  for (std::uint32_t i = 0; i < kOffTicks; ++i) {
    EXPECT_EQ(tick().goal, DriveGoal::kDisabled);
    EXPECT_EQ(orders_.state, OperatingState::kStopping);
  }
  EXPECT_EQ(tick().state, OperatingState::kDisabled);
  EXPECT_EQ(orders_.stop_category, StopCategory::kNone);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(Operation, RestThatIsInterruptedIsCountedAgain) {
  enable();
  arm_.at_rest = false;
  tick(Request::kStop);
  arm_.at_rest = true;
  for (std::uint32_t i = 1; i < kTimeout_s.rest; ++i) tick();
  arm_.at_rest = false;
  tick();
  arm_.at_rest = true;
  for (std::uint32_t i = 1; i < kTimeout_s.rest; ++i) EXPECT_EQ(tick().goal, DriveGoal::kOperationEnabled);
  EXPECT_EQ(tick().goal, DriveGoal::kSwitchedOn);
}

TEST_F(Operation, AStopThatNeverComesToRestEndsInAQuickStop) {
  enable();
  arm_.at_rest = false;
  tick(Request::kStop);
  for (std::uint32_t i = 1; i < kTimeout_s.path_stop; ++i) EXPECT_EQ(tick().goal, DriveGoal::kOperationEnabled);
  EXPECT_EQ(tick().goal, DriveGoal::kQuickStop);
  EXPECT_LE(ticks_until(OperatingState::kDisabled, 20), 20);
}

TEST_F(Operation, AStopTelecommandStopsLikeTheRequest) {
  enable();
  in_force_ = CommandKind::kStop;
  EXPECT_EQ(tick().state, OperatingState::kStopping);
  in_force_ = CommandKind::kNone;
  EXPECT_LE(ticks_until(OperatingState::kDisabled, 100), 100);
}

TEST_F(Operation, AStopWhileEnablingDisablesAll) {
  for (int ticks_before = 0; ticks_before < 6; ++ticks_before) {
    state_ = SupervisorState{};
    inputs_ = healthy(kStatusDisabled, 0);
    arm_.prepared = false;
    tick(Request::kEnable);
    for (int i = 0; i < ticks_before; ++i) tick();
    EXPECT_EQ(tick(Request::kStop).state, OperatingState::kStopping) << ticks_before;
    EXPECT_LE(ticks_until(OperatingState::kDisabled, 100), 100);
    EXPECT_EQ(faults_.count, 0);
  }
}

TEST_F(Operation, AHoldFaultKeepsTheDrivesEnabledAndBlocksMotionUntilCleared) {
  enable();
  tension_N_[2] = 0.0;
  for (int i = 0; i < kSlackDebounceTicks; ++i) tick();
  EXPECT_TRUE(has(faults_, FaultNumber::kCableSlack, 2));
  EXPECT_EQ(orders_.state, OperatingState::kEnabled);
  EXPECT_EQ(orders_.stop_category, StopCategory::kHold);
  EXPECT_EQ(orders_.may_move, MayMove::kRetract);
  EXPECT_TRUE(orders_.live_targets) << "the path stop still moves the drives";
  tick(Request::kClear);
  EXPECT_EQ(state_.clear.missing, static_cast<std::uint32_t>(kCausesGone));
  EXPECT_EQ(orders_.may_move, MayMove::kRetract) << "the cable is still slack";
  tension_N_[2] = 40.0;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tick().may_move, MayMove::kRetract) << "clearing is explicit";
  tick(Request::kClear);
  EXPECT_EQ(state_.clear.missing, 0U);
  EXPECT_EQ(state_.clear.checked, kClearable);
  EXPECT_EQ(state_.clear.tick, inputs_.tick);
  EXPECT_EQ(orders_.may_move, MayMove::kEverything);
  EXPECT_EQ(faults_.count, 0);
}

TEST_F(Operation, AHoldFaultIsNotClearedWhileTheArmStillMoves) {
  enable();
  latch(faults_, {FaultNumber::kCommandInvalid, -1, 0, 1});
  arm_.at_rest = false;
  tick(Request::kClear);
  EXPECT_EQ(state_.clear.missing, static_cast<std::uint32_t>(kAtRest));
  EXPECT_EQ(faults_.count, 1);
}

TEST_F(Operation, ACauseThatPersistsTurnsAHoldIntoAStop) {
  enable();
  tension_N_[2] = 450.0;
  for (std::uint32_t i = 1; i < kAlarmDebounceTicks + kTimeout_s.persist - 1; ++i)
    ASSERT_EQ(tick().state, OperatingState::kEnabled) << i;
  EXPECT_EQ(tick().state, OperatingState::kStopping);
  EXPECT_LE(ticks_until(OperatingState::kFault, 100), 100);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(tick().stop_category, StopCategory::kStop) << "in Fault it still says what happened";
  tension_N_[2] = 40.0;
  tick(Request::kClear);
  EXPECT_LE(ticks_until(OperatingState::kDisabled, 100), 100);
  EXPECT_EQ(orders_.stop_category, StopCategory::kNone);
}

TEST_F(Operation, ACauseThatPersistsDoesNotStopARetractThatMovesButCountsAnewAfterIt) {
  enable();
  tension_N_[2] = 450.0;
  for (std::uint32_t i = 1; i < kAlarmDebounceTicks; ++i) tick();
  in_force_ = CommandKind::kRetract;
  arm_.at_rest = false;
  for (std::uint32_t i = 0; i < 3 * kTimeout_s.persist; ++i) {
    ASSERT_EQ(tick().state, OperatingState::kEnabled) << i;
    ASSERT_EQ(orders_.may_move, MayMove::kRetract) << i;
  }
  arm_.at_rest = true;  // its end, or whatever holds it up
  for (std::uint32_t i = 1; i < kTimeout_s.persist; ++i) ASSERT_EQ(tick().state, OperatingState::kEnabled) << i;
  EXPECT_EQ(tick().state, OperatingState::kStopping);
}

TEST_F(Operation, AnotherCommandThanARetractDoesNotKeepACauseFromStoppingTheArm) {
  enable();
  tension_N_[2] = 450.0;
  in_force_ = CommandKind::kJoint;
  arm_.at_rest = false;
  for (std::uint32_t i = 1; i < kAlarmDebounceTicks + kTimeout_s.persist - 1; ++i)
    ASSERT_EQ(tick().state, OperatingState::kEnabled) << i;
  EXPECT_EQ(tick().state, OperatingState::kStopping);
}

TEST_F(Operation, ADriveThatGoesSilentQuickStopsTheOthersInTheSameTick) {
  enable();
  arm_.at_rest = false;
  inputs_.drive[3].feedback_age_ticks = 3;
  EXPECT_EQ(tick().goal, DriveGoal::kQuickStop);
  EXPECT_FALSE(orders_.live_targets);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i)
    EXPECT_EQ(sent_[i].controlword, kQuickStopCommand);
  const int limit = static_cast<int>(kTimeout_s.quick_stop + kTimeout_s.off_budget) + 2;
  EXPECT_LE(ticks_until(OperatingState::kFault, limit), limit)
      << "a drive that cannot confirm does not hold the others up for ever";
  EXPECT_TRUE(has(faults_, FaultNumber::kDriveStopTimeout, 3));
}

TEST_F(Operation, ALostBusQuickStopsTheOthersInTheSameTick) {
  enable();
  inputs_.lost_bus_mask = 2;
  EXPECT_EQ(tick().goal, DriveGoal::kQuickStop);
}

TEST_F(Operation, AnOverloadedCableTakesTheTorqueAwayAtOnce) {
  enable();
  tension_N_[0] = 700.0;
  for (int i = 1; i < kOverloadDebounceTicks; ++i) EXPECT_EQ(tick().goal, DriveGoal::kOperationEnabled);
  EXPECT_EQ(tick().goal, DriveGoal::kDisabled);
  EXPECT_EQ(orders_.stop_category, StopCategory::kOff);
  EXPECT_EQ(sent_[0].controlword, kDisableVoltage);
}

TEST_F(Operation, AGateRefusalLatchedByTheTickStopsInTheNextOne) {
  enable();
  latch(faults_, {FaultNumber::kGateRefused, 2, 3, inputs_.tick});
  EXPECT_EQ(tick().goal, DriveGoal::kQuickStop);
}

TEST_F(Operation, AFaultOfADriveIsResetByClearAndNothingElse) {
  enable();
  inputs_.drive[1].statusword = kStatusFault;
  EXPECT_LE(ticks_until(OperatingState::kFault, 100), 100);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tick(Request::kEnable).state, OperatingState::kFault);
  EXPECT_EQ(inputs_.drive[1].statusword, kStatusFault);
  tick(Request::kClear);
  EXPECT_EQ(orders_.goal, DriveGoal::kFaultReset);
  EXPECT_EQ(ticks_until(OperatingState::kDisabled, 100), static_cast<int>(kResetTicks));
  EXPECT_EQ(faults_.count, 0);
  EXPECT_EQ(faults_.category, StopCategory::kNone);
  enable();
}

TEST_F(Operation, AClearWhoseCauseIsStillThereReportsItAndStaysInFault) {
  inputs_.drive[1].statusword = kStatusFault;
  stuck_drive_ = 1;
  tick();
  EXPECT_EQ(tick().state, OperatingState::kFault);
  tick(Request::kClear);
  for (std::uint32_t i = 0; i < kTimeout_s.reset_budget; ++i) tick();
  EXPECT_EQ(orders_.goal, DriveGoal::kDisabled) << "back from resetting";
  EXPECT_EQ(orders_.state, OperatingState::kFault);
  EXPECT_EQ(state_.clear.missing, kNoDriveInFault | kCausesGone);
  EXPECT_EQ(faults_.count, 1);
}

TEST_F(Operation, AClearIsJudgedWhenTheDrivesHadTheirResetAndNotBefore) {
  for (const Request asked : {Request::kClear, Request::kRecover}) {
    state_ = SupervisorState{};
    faults_ = {};
    inputs_ = healthy(kStatusDisabled, 0);
    latch(faults_, {FaultNumber::kDriveMissing, 0, 0, 1});
    tick();
    state_.stopped = StopCategory::kOff;  // of the stop that led here
    tick(asked);
    for (std::uint32_t i = 1; i < kResetTicks; ++i) {
      EXPECT_EQ(orders_.stop_category, StopCategory::kOff) << "until it is cleared";
      EXPECT_EQ(faults_.count, 1);
      EXPECT_EQ(state_.clear.tick, 0U);
      tick();
    }
    tick();
    EXPECT_EQ(faults_.count, 0);
    EXPECT_EQ(state_.clear.tick, inputs_.tick);
  }
}

TEST_F(Operation, ADriveThatStaysInFaultHasTheWholeBudgetBeforeAClearIsRefused) {
  inputs_.drive[0].statusword = kStatusFault;
  stuck_drive_ = 0;
  tick();
  tick();
  tick(Request::kClear);
  for (std::uint32_t i = 1; i < kTimeout_s.reset_budget; ++i) tick();
  EXPECT_EQ(state_.clear.tick, 0U);
  tick();
  EXPECT_EQ(state_.clear.tick, inputs_.tick);
  EXPECT_EQ(state_.clear.missing, kNoDriveInFault | kCausesGone);
}

TEST_F(Operation, ClearingChecksHomingAgain) {
  latch(faults_, {FaultNumber::kHomingImplausible, 0, 0, 1});
  arm_.homed = false;
  EXPECT_EQ(tick().state, OperatingState::kFault);
  tick(Request::kClear);
  for (std::uint32_t i = 0; i <= kResetTicks; ++i) tick();
  EXPECT_EQ(state_.clear.missing, static_cast<std::uint32_t>(kHomed));
  EXPECT_EQ(orders_.state, OperatingState::kFault);
  arm_.homed = true;
  tick(Request::kClear);
  EXPECT_LE(ticks_until(OperatingState::kDisabled, 20), 20);
}

}  // namespace
}  // namespace liana::cable
