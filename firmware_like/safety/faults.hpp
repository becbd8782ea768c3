// Numbered faults: one number, the same in logs, Lua, console and docs.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace liana {

// How the arm comes to rest. A higher category wins, and a stop at once over one along the path
// (docs/explanation/fault-detection.md).
enum class StopCategory : std::uint8_t { kNone = 0, kHold = 1, kStop = 2, kOff = 3 };

// 1xxx command, 2xxx motion, 3xxx drive, 4xxx bus, 5xxx cable, 6xxx internal. Numbers never change meaning.
enum class FaultNumber : std::uint16_t {
  kNone = 0,
  kCommandInvalid = 1001,       // a released command held a value that is not finite or out of range
  kTicksLost = 2001,            // more deadlines lost in a row than allowed
  kJointOutOfRange = 2002,      // a joint with power stands beyond the end of its range
  kJointJump = 2003,            // an encoder of a joint, or of a base's drive, changed faster than that can move
  kWristSensorLost = 2004,      // in a push the wrist's force sensor is not to be trusted
  kPushOverload = 2005,         // a push met more force, or a joint more torque, than it may
  kDriveMissing = 3001,         // no heartbeat from a drive
  kDriveSilent = 3002,          // no TPDO for more than two ticks
  kDriveFault = 3003,           // drive reports fault (EMCY code beside it)
  kDriveLeftOperation = 3004,   // drive left Operation enabled by itself
  kDriveEnableTimeout = 3005,   // drive did not follow the enable sequence
  kFollowingError = 3006,       // motor does not follow its target
  kDriveNotOperational = 3007,  // NMT state is no longer operational
  kDriveStopTimeout = 3008,     // drive did not confirm that it is without power
  kNodeTwice = 3009,            // somebody else speaks under the identifiers of a drive
  kDriveOtherMode = 3010,       // a drive that follows targets shows another mode than it was told
  kBusLost = 4001,
  kCableSlack = 5001,         // tension under the floor for too long
  kCableOverload = 5002,      // tension, or force of a base's drive, over the hard limit
  kTensionAlarm = 5003,       // tension over the alarm limit
  kHomingImplausible = 5004,  // lengths of one segment's cables contradict each other
  kCableSlip = 5005,          // length and tension of a cable stopped agreeing: it slipped, or its encoder jumped
  kCableBreak = 5006,         // a cable's tension was gone from one moment to the next
  kTensionScatters = 5007,    // a cable's readings jump to and fro
  kBodyContact =
      5008,  // something pushes the body: torques of a segment's cables, or of a base's drive, do not balance
  kFrictionNotAsDeclared = 5009,  // friction was found that was not declared and that no tension plan carries
  kLoadCellLost = 5010,           // a load cell gives no usable reading
  kLoadCellContradicts = 5011,    // a load cell and the torque of its drive do not agree
  kGateRefused = 6001,            // the gate saw a command that must not reach a drive
};

struct Fault {
  FaultNumber number = FaultNumber::kNone;
  std::int16_t index = -1;   // drive or bus, 0-based; -1 = none
  std::uint16_t detail = 0;  // EMCY code, statusword or similar
  std::uint64_t tick = 0;    // when it was latched
};

// Latched faults, oldest first; when full, `dropped` counts the rest, which still raise `category` and `immediate`.
struct FaultList {
  static constexpr std::int32_t kCapacity = 16;
  std::array<Fault, kCapacity> fault{};
  std::int32_t count = 0;
  std::uint32_t dropped = 0;
  StopCategory category = StopCategory::kNone;  // highest of all that was latched since the last clear
  std::uint8_t immediate = 0;                   // 1: at least one of them rules out a stop along the path
};

// What is known about a fault number, the same for logs, Lua, console and docs.
struct FaultInfo {
  FaultNumber number = FaultNumber::kNone;
  const char* name = "";  // snake_case
  StopCategory category = StopCategory::kNone;
  bool immediate = false;   // drives cannot follow a path any more: quick stop in the same tick instead of a path stop
  bool retract = false;     // while it is latched the arm may still be led back slowly (CommandKind::kRetract)
  const char* text = "";    // what happened, one line
  const char* remedy = "";  // what to do about it, one line
};

// Every fault number there is, in ascending order, kNone first.
std::span<const FaultInfo> all_faults() noexcept;

// Entry of a fault number; the entry of kNone for a number that does not exist.
const FaultInfo& fault_info(FaultNumber number) noexcept;

// True when every latched fault lets the arm be led back: none ends the power, and all are known (none was dropped).
// Without a fault: true.
bool allow_retract(const FaultList& faults) noexcept;

// Latches a fault; true when it is new. The same number and index is kept once (a detail that was 0 is filled in); what
// finds no room is counted in `dropped`.
bool latch(FaultList& list, const Fault& fault) noexcept;

}  // namespace liana
