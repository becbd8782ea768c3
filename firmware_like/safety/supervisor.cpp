#include "firmware_like/safety/supervisor.hpp"

#include <array>
#include <limits>

#include "firmware_like/math/convert.hpp"

namespace liana {
namespace {

constexpr std::uint32_t kForever = std::numeric_limits<std::uint32_t>::max();

// What a phase means outside, what it tells the drives, and how long it lasts.
struct PhaseTraits {
  OperatingState state;
  DriveGoal goal;
  StopCategory stop;
  bool live_targets;
  std::uint32_t Patience::*least;
  std::uint32_t Patience::*most;
};

constexpr std::array<PhaseTraits, kPhaseCount> kPhaseTable{{
    {OperatingState::kDisabled, DriveGoal::kDisabled, StopCategory::kNone, false, &Patience::none, &Patience::forever},
    {OperatingState::kEnabling, DriveGoal::kSwitchedOn, StopCategory::kNone, false, &Patience::none,
     &Patience::powering},
    {OperatingState::kEnabling, DriveGoal::kOperationEnabled, StopCategory::kNone, false, &Patience::none,
     &Patience::powering},
    {OperatingState::kEnabling, DriveGoal::kOperationEnabled, StopCategory::kNone, true, &Patience::none,
     &Patience::preparing},
    {OperatingState::kEnabled, DriveGoal::kOperationEnabled, StopCategory::kNone, true, &Patience::none,
     &Patience::forever},
    {OperatingState::kStopping, DriveGoal::kOperationEnabled, StopCategory::kStop, true, &Patience::none,
     &Patience::path_stop},
    {OperatingState::kStopping, DriveGoal::kSwitchedOn, StopCategory::kStop, false, &Patience::braking,
     &Patience::braking},
    {OperatingState::kStopping, DriveGoal::kQuickStop, StopCategory::kStop, false, &Patience::none,
     &Patience::quick_stop},
    {OperatingState::kStopping, DriveGoal::kDisabled, StopCategory::kOff, false, &Patience::off, &Patience::off_budget},
    {OperatingState::kFault, DriveGoal::kDisabled, StopCategory::kNone, false, &Patience::none, &Patience::forever},
    {OperatingState::kFault, DriveGoal::kFaultReset, StopCategory::kNone, false, &Patience::reset,
     &Patience::reset_budget},
}};

struct Transition {
  Phase from;
  std::uint32_t all_of;
  std::uint32_t none_of;
  Phase to;
};

// First row that fits wins; none: the phase stays. Rows that stop stand before rows that go on.
constexpr std::array kTransitions{
    Transition{Phase::kDisabled, kFaultHold, 0, Phase::kFault},
    Transition{Phase::kDisabled, kAskEnable | kReady, kAskStop, Phase::kSwitchingOn},

    Transition{Phase::kSwitchingOn, kFaultHold, 0, Phase::kPowerDown},
    Transition{Phase::kSwitchingOn, kAskStop, 0, Phase::kPowerDown},
    Transition{Phase::kSwitchingOn, kAllSwitchedOn, 0, Phase::kPowering},

    Transition{Phase::kPowering, kFaultHold, 0, Phase::kPowerDown},
    Transition{Phase::kPowering, kAskStop, 0, Phase::kPowerDown},
    Transition{Phase::kPowering, kAllEnabled, 0, Phase::kPreparing},

    Transition{Phase::kPreparing, kFaultOff, 0, Phase::kPowerDown},
    Transition{Phase::kPreparing, kFaultImmediate, 0, Phase::kQuickStop},
    Transition{Phase::kPreparing, kFaultHold, 0, Phase::kBraking},  // no motion yet: nothing to decelerate but the ramp
    Transition{Phase::kPreparing, kAskStop, 0, Phase::kBraking},
    Transition{Phase::kPreparing, kPrepared, 0, Phase::kEnabled},

    Transition{Phase::kEnabled, kFaultOff, 0, Phase::kPowerDown},
    Transition{Phase::kEnabled, kFaultImmediate, 0, Phase::kQuickStop},
    Transition{Phase::kEnabled, kFaultStop, 0, Phase::kPathStop},
    Transition{Phase::kEnabled, kFaultPersists, 0, Phase::kPathStop},
    Transition{Phase::kEnabled, kAskStop, 0, Phase::kPathStop},

    Transition{Phase::kPathStop, kFaultOff, 0, Phase::kPowerDown},
    Transition{Phase::kPathStop, kFaultImmediate, 0, Phase::kQuickStop},
    Transition{Phase::kPathStop, kAtRest, 0, Phase::kBraking},
    Transition{Phase::kPathStop, kBudgetSpent, 0, Phase::kQuickStop},

    Transition{Phase::kBraking, kFaultOff, 0, Phase::kPowerDown},
    Transition{Phase::kBraking, kCounted, 0, Phase::kPowerDown},

    Transition{Phase::kQuickStop, kFaultOff, 0, Phase::kPowerDown},
    Transition{Phase::kQuickStop, kAllOff, 0, Phase::kPowerDown},
    Transition{Phase::kQuickStop, kBudgetSpent, 0, Phase::kPowerDown},

    Transition{Phase::kPowerDown, kAllOff | kCounted | kFaultHold, 0, Phase::kFault},
    Transition{Phase::kPowerDown, kAllOff | kCounted, 0, Phase::kDisabled},
    Transition{Phase::kPowerDown, kBudgetSpent, 0, Phase::kFault},

    Transition{Phase::kFault, kAskClear, 0, Phase::kResetting},

    Transition{Phase::kResetting, kCounted | kNoDriveInFault | kFaultHold, 0, Phase::kFault},
    Transition{Phase::kResetting, kCounted | kNoDriveInFault, 0, Phase::kDisabled},
    Transition{Phase::kResetting, kBudgetSpent, 0, Phase::kFault},
};

// Where the rows of a phase begin: they stand together, in the order of the phases.
constexpr std::array<std::size_t, kPhaseCount> kFirstRow = [] {
  std::array<std::size_t, kPhaseCount> first{};
  for (std::size_t i = kTransitions.size(); i-- > 0;) first[static_cast<std::size_t>(kTransitions[i].from)] = i;
  return first;
}();
static_assert([] {
  for (std::size_t i = 1; i < kTransitions.size(); ++i)
    if (kTransitions[i].from < kTransitions[i - 1].from) return false;
  return kFirstRow.back() + 3 == kTransitions.size() && kFirstRow.front() == 0;
}());

const PhaseTraits& traits_of(Phase phase) noexcept { return kPhaseTable[static_cast<std::size_t>(phase)]; }

std::uint32_t request_conditions(Request request, CommandKind in_force) noexcept {
  if (request == Request::kStop || request == Request::kDisable || in_force == CommandKind::kStop) return kAskStop;
  if (request == Request::kEnable) return kAskEnable;
  return request == Request::kClear || request == Request::kRecover ? static_cast<std::uint32_t>(kAskClear) : 0;
}

std::uint32_t conditions_now(const LinkLimits& limits, const CycleInputs& inputs, const ArmStatus& arm,
                             CommandKind in_force, std::int32_t active_faults, const SupervisorState& state) noexcept {
  const PhaseTraits& traits = traits_of(state.phase);
  std::uint32_t set = drive_conditions(limits, inputs) | request_conditions(inputs.request, in_force);
  if (arm.homed) set |= kHomed;
  if (arm.prepared) set |= kPrepared;
  if (state.rest_ticks >= limits.patience.rest || !traits.live_targets)
    set |= kAtRest;  // without live targets nothing commands motion
  if (active_faults == 0) set |= kCausesGone;
  if (state.wrong_ticks >= limits.patience.persist) set |= kFaultPersists;
  if (state.phase_ticks >= limits.patience.*traits.least) set |= kCounted;
  if (state.phase_ticks >= limits.patience.*traits.most) set |= kBudgetSpent;
  return set;
}

// Latches a timeout for every drive that is not where the phase wants it.
void name_late_drives(const LinkLimits& limits, const CycleInputs& inputs, FaultNumber number, std::uint32_t wanted,
                      FaultList& faults) noexcept {
  for (std::int32_t i = 0; i < limits.drive_count; ++i) {
    const DriveFeedback& drive = inputs.drive[as_index(i)];
    if ((drive_conditions_of(limits, drive) & wanted) == wanted) continue;
    latch(faults, {number, narrow<std::int16_t>(i), drive.statusword, inputs.tick});
  }
}

void latch_timeouts(const LinkLimits& limits, const CycleInputs& inputs, const ArmStatus& arm, Phase phase,
                    std::uint32_t now, FaultList& faults) noexcept {
  if ((now & kBudgetSpent) == 0) return;
  if (phase == Phase::kSwitchingOn)
    name_late_drives(limits, inputs, FaultNumber::kDriveEnableTimeout, kAllSwitchedOn, faults);
  if (phase == Phase::kPowering)
    name_late_drives(limits, inputs, FaultNumber::kDriveEnableTimeout, kAllEnabled, faults);
  if (phase == Phase::kPowerDown) name_late_drives(limits, inputs, FaultNumber::kDriveStopTimeout, kAllOff, faults);
  if (phase == Phase::kPreparing && (now & kPrepared) == 0) {
    const std::uint16_t status = arm.slack < 0 ? std::uint16_t{0} : inputs.drive[as_index(arm.slack)].statusword;
    latch(faults, {FaultNumber::kDriveEnableTimeout, arm.slack, status, inputs.tick});
  }
}

// A clear is judged at once while enabled (only holds are latched there), and in Fault after the drives had their
// reset.
bool is_clear_due(Phase phase, std::uint32_t now) noexcept {
  if (phase == Phase::kEnabled) return (now & kAskClear) != 0;
  return phase == Phase::kResetting &&
         (((now & kCounted) != 0 && (now & kNoDriveInFault) != 0) || (now & kBudgetSpent) != 0);
}

void judge_clear(std::uint64_t tick, std::uint32_t now, SupervisorState& state, FaultList& faults) noexcept {
  state.clear = {tick, kClearable, kClearable & ~now};
  if (state.clear.missing == 0) faults = FaultList{};
}

// Counts ticks in a row in which something holds, up to `most`.
void count(bool holds, std::uint32_t most, std::uint32_t& ticks) noexcept {
  if (!holds) ticks = 0;
  if (holds && ticks < most) ++ticks;
}

Phase next_phase(Phase phase, std::uint32_t now) noexcept {
  for (std::size_t i = kFirstRow[static_cast<std::size_t>(phase)]; i < kTransitions.size(); ++i) {
    const Transition& row = kTransitions[i];
    if (row.from != phase) break;
    if ((now & row.all_of) == row.all_of && (now & row.none_of) == 0) return row.to;
  }
  return phase;
}

void enter(Phase next, SupervisorState& state) noexcept {
  if (next != state.phase) {
    state.phase = next;
    state.phase_ticks = 0;
  }
  if (state.phase_ticks < kForever) ++state.phase_ticks;
}

StopCategory higher(StopCategory a, StopCategory b) noexcept { return a > b ? a : b; }

// A hold that persisted became a stop, and stays one in Fault. Taking the power away ends every stop and does not
// count.
void remember_stop(const FaultList& faults, SupervisorState& state) noexcept {
  const bool after =
      state.phase == Phase::kPowerDown || state.phase == Phase::kFault || state.phase == Phase::kResetting;
  const StopCategory before = after ? state.stopped : traits_of(state.phase).stop;
  state.stopped = higher(before, faults.category);
}

// Faults that hold leave the way out open while the arm can still be measured.
MayMove may_move(std::uint32_t now, const ArmStatus& arm, const FaultList& faults) noexcept {
  if (faults.category == StopCategory::kNone) return arm.recovers ? MayMove::kRetract : MayMove::kEverything;
  return (now & kSound) == kSound && allow_retract(faults) ? MayMove::kRetract : MayMove::kNothing;
}

Orders orders_of(const SupervisorState& state, std::uint32_t now, const ArmStatus& arm,
                 const FaultList& faults) noexcept {
  const Phase phase = state.phase;
  const PhaseTraits& traits = traits_of(phase);
  Orders orders{};
  orders.state = traits.state;
  orders.goal = traits.goal;
  orders.stop_category = higher(traits.stop, state.stopped);
  orders.live_targets = traits.live_targets;
  if (phase == Phase::kEnabled) orders.may_move = may_move(now, arm, faults);
  orders.preparing = phase == Phase::kPreparing;
  orders.enable_missing = kReady & ~now;
  return orders;
}

}  // namespace

WatchScope watch_scope(const SupervisorState& state) noexcept {
  const bool powered = traits_of(state.phase).live_targets;
  return {powered, powered && state.phase != Phase::kPreparing};
}

Orders supervise(const LinkLimits& limits, const CycleInputs& inputs, const ArmStatus& arm, CommandKind in_force,
                 std::int32_t active_faults, SupervisorState& state, FaultList& faults) noexcept {
  count(arm.at_rest, limits.patience.rest, state.rest_ticks);
  const bool retracts = in_force == CommandKind::kRetract && !arm.at_rest;
  count(active_faults != 0 && !retracts, limits.patience.persist, state.wrong_ticks);
  std::uint32_t now = conditions_now(limits, inputs, arm, in_force, active_faults, state);
  latch_timeouts(limits, inputs, arm, state.phase, now, faults);
  if (is_clear_due(state.phase, now)) judge_clear(inputs.tick, now, state, faults);
  now |= fault_conditions(faults);
  enter(next_phase(state.phase, now), state);
  remember_stop(faults, state);
  return orders_of(state, now, arm, faults);
}

}  // namespace liana
