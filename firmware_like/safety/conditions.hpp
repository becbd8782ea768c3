// Conditions of one tick as a bit-field: what the supervisor's table triggers on.
#pragma once

#include <cstdint>

#include "firmware_like/safety/drive_link_monitor.hpp"

namespace liana {

enum Condition : std::uint32_t {
  // What has to be true before the drives may be enabled.
  kBusesUp = 1u << 0,
  kDrivesFresh = 1u << 1,        // feedback and heartbeat of every drive within their ages
  kDrivesOperational = 1u << 2,  // NMT
  kNoDriveInFault = 1u << 3,
  kHomed = 1u << 4,
  kNoFault = 1u << 5,  // nothing is latched
  // Where the drives are.
  kAllSwitchedOn = 1u << 6,  // every drive in Switched on or Operation enabled
  kAllEnabled = 1u << 7,     // every drive in Operation enabled
  kAllOff = 1u << 8,         // every drive known to be without power
  // Motion.
  kAtRest = 1u << 9,  // commanded motion has ended, for Patience::rest in a row
  kPrepared = 1u << 10,
  // What is asked.
  kAskEnable = 1u << 11,
  kAskStop = 1u << 12,  // stop, disable or a stop telecommand
  kAskClear = 1u << 13,
  // Latched faults.
  kFaultHold = 1u << 14,       // any fault
  kFaultStop = 1u << 15,       // category stop or higher
  kFaultImmediate = 1u << 16,  // no path stop possible
  kFaultOff = 1u << 17,
  // Time in the present phase.
  kCounted = 1u << 18,      // the phase's least number of ticks has passed
  kBudgetSpent = 1u << 19,  // the phase's largest number of ticks has passed
  // Nothing is wrong in this tick (latched or not).
  kCausesGone = 1u << 20,
  kFaultPersists = 1u << 21,  // something has been wrong for Patience::persist in a row, without a retract that moves
};

// Every drive is heard and the measured pose is trusted: what a retract needs besides faults that allow it.
constexpr std::uint32_t kSound = kBusesUp | kDrivesFresh | kDrivesOperational | kNoDriveInFault | kHomed;

// All that enabling needs.
constexpr std::uint32_t kReady = kSound | kNoFault;

// All that clearing a fault checks.
constexpr std::uint32_t kClearable = kSound | kAtRest | kCausesGone;

// The conditions on all drives that this one drive meets.
std::uint32_t drive_conditions_of(const LinkLimits& limits, const DriveFeedback& drive) noexcept;

// The conditions that buses and drives show in this tick.
std::uint32_t drive_conditions(const LinkLimits& limits, const CycleInputs& inputs) noexcept;

// The conditions that the latched faults show.
std::uint32_t fault_conditions(const FaultList& faults) noexcept;

// Name of one condition bit as logs print it, e.g. "drives_fresh"; "unknown" when `bit` is not exactly one known bit.
const char* condition_name(std::uint32_t bit) noexcept;

}  // namespace liana
