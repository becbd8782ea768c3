// The operating state machine: when drives are powered, when the arm may move, how it stops, how faults are cleared.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware_like/command/telecommand.hpp"
#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/safety/conditions.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"

namespace liana {

// CRTK-like operating states.
enum class OperatingState : std::uint8_t { kDisabled = 0, kEnabling = 1, kEnabled = 2, kStopping = 3, kFault = 4 };
// Their names, as states and reports have them, by the enumerators' values.
inline constexpr std::array<const char*, 5> kOperatingStateNames{"DISABLED", "ENABLING", "ENABLED", "STOPPING",
                                                                 "FAULT"};

// The operating states, split where the drives are told different things.
enum class Phase : std::uint8_t {
  kDisabled = 0,
  kSwitchingOn = 1,  // all drives to Switched on: no brake opens before every drive is there
  kPowering = 2,     // all drives to Operation enabled, target = actual
  kPreparing = 3,    // the arm makes itself ready: a cable arm pretensions and looks for slack
  kEnabled = 4,
  kPathStop = 5,   // decelerate along the path
  kBraking = 6,    // at rest: brakes close, power stays
  kQuickStop = 7,  // drives stop on their own ramps
  kPowerDown = 8,  // power off until every drive confirms
  kFault = 9,
  kResetting = 10,  // fault reset edges, then the clear check
};
constexpr std::int32_t kPhaseCount = 11;

// What a clear looked at; bits of Condition. Cleared when `missing` is 0.
struct ClearResult {
  std::uint64_t tick = 0;     // 0 = nothing was ever asked
  std::uint32_t checked = 0;  // kClearable
  std::uint32_t missing = 0;
};

struct SupervisorState {
  Phase phase = Phase::kDisabled;
  std::uint32_t phase_ticks = 0;  // ticks spent in it, saturating
  std::uint32_t rest_ticks = 0;   // in a row at rest, up to Patience::rest
  std::uint32_t wrong_ticks = 0;  // in a row with something wrong and no retract that moves, up to Patience::persist
  StopCategory stopped =
      StopCategory::kNone;  // highest category of the stop that led into Fault; kept until the faults are cleared
  ClearResult clear{};
};
static_assert(std::is_trivially_copyable_v<SupervisorState>);

// What the arm tells the supervisor.
struct ArmStatus {
  bool homed = false;       // the measured pose is trusted
  bool at_rest = false;     // commanded motion has ended in this tick
  bool prepared = false;    // ready for motion: a cable arm has its ramp at its end and no cable slack
  bool recovers = false;    // without a cable that is lost: only a retract may move it
  std::int16_t slack = -1;  // drive of the first cable that keeps it from being prepared; -1: none does
};

// What telecommands may move.
enum class MayMove : std::uint8_t { kNothing = 0, kRetract = 1, kEverything = 2 };

// True when a command of this kind may move the arm. Kinds without a goal never do.
constexpr bool is_let_move(MayMove allowed, CommandKind kind) noexcept {
  if (allowed == MayMove::kRetract) return kind == CommandKind::kRetract;
  return allowed == MayMove::kEverything && is_motion(kind);
}

// What the supervisor orders for this tick.
struct Orders {
  OperatingState state = OperatingState::kDisabled;
  StopCategory stop_category = StopCategory::kNone;  // in Fault: of the stop that led there
  DriveGoal goal = DriveGoal::kDisabled;             // of every drive
  MayMove may_move =
      MayMove::kNothing;   // whatever may not move decelerates along its path and holds while live_targets
  bool preparing = false;  // the arm makes itself ready, starting at the targets sent last
  bool live_targets =
      false;  // proposals go to the drives; otherwise the gate freezes targets or follows actual positions
  std::uint32_t enable_missing = 0;  // bits of kReady that keep the drives from being enabled
};

// What the watchdogs have to look at while in the phase that the last tick ended in.
WatchScope watch_scope(const SupervisorState& state) noexcept;

// One step of the state machine, after the watchdogs and before the gate. `in_force`: kind of the telecommand that
// is in force; `active_faults`: how many conditions the watchdogs find wrong now. Latches enable and stop timeouts,
// clears `faults` when asked and all of kClearable holds. Acts on this tick's inputs in this tick.
Orders supervise(const LinkLimits& limits, const CycleInputs& inputs, const ArmStatus& arm, CommandKind in_force,
                 std::int32_t active_faults, SupervisorState& state, FaultList& faults) noexcept;

}  // namespace liana
