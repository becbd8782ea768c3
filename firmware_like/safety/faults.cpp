#include "firmware_like/safety/faults.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/enumerators.hpp"
#include "firmware_like/safety/fault_causes.hpp"

namespace liana {
namespace {

using enum FaultNumber;

constexpr StopCategory kHold = StopCategory::kHold;
constexpr StopCategory kStop = StopCategory::kStop;

// A new number without a row does not compile.
constexpr std::array<FaultInfo, count_enumerators<FaultNumber, 1000>()> kFaultTable{{
    {kNone, "none", StopCategory::kNone, false, true, "No fault.", "Nothing to do."},
    {kCommandInvalid, "command_invalid", kHold, false, true,
     "An issued command held a value that is not finite or out of range.",
     "Look at the command (liana commands) by its sequence number; correct the client that sent it, then clear."},
    {kTicksLost, "ticks_lost", kStop, true, false,
     "More control deadlines in a row were lost than the drives tolerate.",
     "Run liana doctor, free the computer's cores from other work, then clear and enable again."},
    {kJointOutOfRange, "joint_out_of_range", kStop, true, false,
     "A joint with power stands beyond the end of its range.",
     "Look for what pushes it, and compare the drive's stored zero with the robot table; move it back by hand with the "
     "brakes' release "
     "procedure, then clear."},
    {kJointJump, "joint_jump", kStop, true, false,
     "The encoder of a joint, or of a base's drive, changed faster than that can move.",
     "Check the encoder and its cable; compare where the joint or base stands with the arm by eye, then clear and "
     "enable again."},
    {kWristSensorLost, "wrist_sensor_lost", kHold, false, true,
     "During an insertion the wrist's force sensor was unusable; the detail is 1 no sample, 2 saturated, 3 failed, "
     "4 no number, 5 not at rest before the insertion, 6 equal samples.",
     "The arm gives way to forces; check sensor and cable, then clear, and back off before another insertion."},
    {kPushOverload, "insert_overload", kHold, false, true,
     "An insertion met more force, or a joint more torque, than allowed; if it was a joint, the drive names it; the "
     "detail is in N or N m.",
     "Look for what jams; clear, back off along the axis, and insert again with less force or better aligned."},
    {kDriveMissing, "drive_missing", kStop, true, false, "A drive sent no heartbeat within the allowed time.",
     "Check the drive's supply and its bus connector, then clear, which boots what came back."},
    {kDriveSilent, "drive_silent", kStop, true, false, "A drive sent no feedback for more than two ticks.",
     "Check the bus for errors and load, and the drive's supply, then clear, which boots what came back."},
    {kDriveFault, "drive_fault", kStop, true, false, "A drive reports a fault; the detail is its emergency code.",
     "Look the emergency code up in the drive's manual and remove the cause; clear resets the drive."},
    {kDriveLeftOperation, "drive_left_operation", kStop, true, false,
     "A drive left Operation enabled by itself; the detail is its statusword.",
     "Check STO line, supply and the drive's log, then clear and enable again."},
    {kDriveEnableTimeout, "drive_enable_timeout", kStop, true, false,
     "A drive, or the tension of its cable, did not finish the enable sequence in time.",
     "Look at the drive's state (detail is its statusword), supply and STO line. Where the drive is "
     "enabled, its cable took no tension, as all do beside a broken one: look at the segment's cables on their drums. "
     "Then clear and enable again."},
    {kFollowingError, "following_error", kStop, true, false,
     "A motor does not follow its target within the allowed lag.",
     "Check brake, and drum and cable or gear, for blockage; compare the servo time constant with the robot table, "
     "then clear."},
    {kDriveNotOperational, "drive_not_operational", kStop, true, false, "A drive left the NMT state operational.",
     "The drive restarted, lost the master's heartbeat, or was stopped by another master; a restarted drive is booted "
     "by "
     "itself, the others by clear."},
    {kDriveStopTimeout, "drive_stop_timeout", kStop, true, false, "A drive did not confirm that it is without power.",
     "Use the STO switch; do not approach the arm before the drive shows Switch on disabled, then clear."},
    {kNodeTwice, "duplicate_node_id", kStop, true, false,
     "Another sender uses the identifiers of a drive: two drives have one node id, or another master commands it.",
     "Look for a second drive with this node id, or another program that commands drives; give each drive an id of its "
     "own or end the program, then clear."},
    {kDriveOtherMode, "drive_other_mode", kStop, true, false,
     "A drive with power shows another mode of operation (6061) than it was told: it does not follow its targets.",
     "Look for another tool or master that writes 6060, and for a setting of the drive that changes its mode; then "
     "clear "
     "and enable again."},
    {kBusLost, "bus_lost", kStop, true, false, "A drive bus is down, in bus-off, or none of its drives sends.",
     "Check connector, termination and interface state of the bus, then clear."},
    {kCableSlack, "cable_slack", kHold, false, true, "A cable's tension stayed under the floor.",
     "Retract if the arm is in the way; disable, look at the cable on its drum, then clear and enable: enabling "
     "tightens it."},
    {kCableOverload, "cable_overload", StopCategory::kOff, true, false,
     "A cable's tension, or the force of a base's drive, went over the hard limit.",
     "Free the arm by hand with the brakes' release procedure, inspect cable or guide, then clear."},
    {kTensionAlarm, "tension_alarm", kHold, false, true, "A cable's tension stayed over the alarm limit.",
     "Look for contact and retract from it; clear when the tension is under the limit again."},
    {kHomingImplausible, "homing_implausible", kHold, false, true,
     "The lengths of one segment's cables contradict each other; the detail is by how many micrometres.",
     "Retract, disable and clear; look for a cable of this segment that creeps on its drum, and "
     "measure the zeros again (liana calibrate)."},
    {kCableSlip, "cable_slip", kHold, false, true,
     "A cable slipped on its drum, or its encoder jumped: length and tension no longer agree; the detail is "
     "micrometres of cable.",
     "Retract, disable and clear; look at the clamp on the drum, the encoder, and the load cell if it has one. The "
     "cable's zero is wrong now: measure it again (liana calibrate)."},
    {kCableBreak, "cable_break", kStop, false, false,
     "A cable's tension was gone from one moment to the next: it broke or came off its drum, or its reading is lost. "
     "An arm with weight keeps all drums where they are: five cables a segment hold it, three or four may let it fall.",
     "Stay away from the arm. liana recover leads it back along its path without this cable. Then look at the cable, "
     "its "
     "clamp on the drum and the drive's torque reading; liana clear --whole says that the cable is whole."},
    {kTensionScatters, "tension_scatters", kHold, false, true, "Readings of a cable jump back and forth.",
     "Retract and disable; check the drive's torque and position measurement and its cable, then clear."},
    {kBodyContact, "body_contact", kHold, false, true,
     "A force acts on the arm's body: the torques of its cables do not balance, or a drive of its base meets more than "
     "its load; the drive is that one, or the first of the touched segment, if that is known; the detail is in 0.01 N "
     "m.",
     "Look where the arm touches, or what it carries untold (request payload); retract, or take that away, then "
     "clear."},
    {kFrictionNotAsDeclared, "friction_not_as_declared", kHold, false, true,
     "Friction of the cables is higher than declared, and higher than plans of tensions allow; the detail is mu in "
     "0.0001.",
     "Retract and disable; look for a weight that it was not told of (request payload), worn holes or dirt, then "
     "measure "
     "again (liana calibrate --friction), and clear."},
    {kLoadCellLost, "load_cell_lost", kHold, false, true,
     "A cable's load cell gives no usable reading; tension is taken from the drive's torque since.",
     "Retract and disable; check the cell, its amplifier and its plug, then clear. With load_cell.when_lost = "
     "\"torque\" in the bus table the arm goes on without it."},
    {kLoadCellContradicts, "load_cell_contradicts", kHold, false, true,
     "A cable's load cell and the torque of its drive do not agree; tension is taken from the torque since.",
     "Retract and disable; compare both with the cable slack: both should read 0. Set the zero of the one that does "
     "not, or replace it, then clear."},
    {kGateRefused, "gate_refused", kStop, true, false,
     "The gate saw a command that must not reach a drive; the detail names the check.",
     "This is a defect: keep the recording and report it; the arm stands at its last good target, then clear."},
}};

// What follows from a fault: of the same drive, or of any. A drive without power or bus is missed by everything that
// looks at it; a cable that is gone leaves others slack or pulled, and lengths that contradict each other.
struct Consequence {
  FaultNumber cause, follows;
  bool same_drive;
};
constexpr Consequence kConsequences[] = {
    {kTicksLost, kDriveMissing, false},
    {kTicksLost, kDriveSilent, false},
    {kTicksLost, kDriveFault, false},
    {kTicksLost, kDriveLeftOperation, false},
    {kTicksLost, kDriveNotOperational, false},
    {kBusLost, kDriveMissing, false},
    {kBusLost, kDriveSilent, false},
    {kBusLost, kDriveFault, false},
    {kBusLost, kDriveLeftOperation, false},
    {kBusLost, kDriveEnableTimeout, false},
    {kBusLost, kDriveNotOperational, false},
    {kBusLost, kDriveStopTimeout, false},
    {kNodeTwice, kDriveFault, true},
    {kNodeTwice, kFollowingError, true},
    {kDriveSilent, kDriveMissing, true},
    {kDriveSilent, kDriveFault, true},
    {kDriveSilent, kDriveLeftOperation, true},
    {kDriveSilent, kDriveEnableTimeout, true},
    {kDriveSilent, kFollowingError, true},
    {kDriveSilent, kDriveNotOperational, true},
    {kDriveSilent, kDriveStopTimeout, true},
    {kDriveMissing, kDriveSilent, true},
    {kDriveMissing, kDriveEnableTimeout, true},
    {kDriveMissing, kDriveNotOperational, true},
    {kDriveMissing, kDriveStopTimeout, true},
    {kDriveNotOperational, kDriveSilent, true},
    {kDriveNotOperational, kDriveMissing, true},
    {kDriveNotOperational, kDriveFault, true},
    {kDriveNotOperational, kDriveLeftOperation, true},
    {kDriveNotOperational, kFollowingError, true},
    {kDriveFault, kDriveLeftOperation, true},
    {kDriveFault, kDriveEnableTimeout, true},
    {kDriveFault, kFollowingError, true},
    {kDriveFault, kDriveStopTimeout, true},
    {kDriveLeftOperation, kDriveEnableTimeout, true},
    {kDriveLeftOperation, kFollowingError, true},
    {kDriveLeftOperation, kDriveStopTimeout, true},
    {kCableBreak, kFollowingError, false},
    {kCableBreak, kCableSlack, false},
    {kCableBreak, kTensionAlarm, false},
    {kCableBreak, kHomingImplausible, false},
    {kCableBreak, kCableSlip, false},
    {kCableBreak, kTensionScatters, false},
    {kCableBreak, kBodyContact, false},
    {kCableBreak, kFrictionNotAsDeclared, false},
    {kCableSlip, kHomingImplausible, false},
};

constexpr bool is_complete() noexcept {
  for (std::int32_t row = 0; row < static_cast<std::int32_t>(kFaultTable.size()); ++row) {
    const FaultInfo& info = kFaultTable[as_index(row)];
    if (info.name[0] == '\0' || info.text[0] == '\0' || info.remedy[0] == '\0') return false;
    if (row > 0 && (info.number <= kFaultTable[as_index(row - 1)].number || info.category == StopCategory::kNone))
      return false;
    if (info.immediate && info.category < kStop) return false;  // a hold keeps the drives on the path
    if (info.retract && info.category > kHold) return false;    // without power nothing can be led back
  }
  return true;
}
static_assert(is_complete(), "fault table: every number once, ascending, with name, category, text and remedy");

void raise(FaultList& list, const FaultInfo& info) noexcept {
  if (info.category > list.category) list.category = info.category;
  if (info.immediate) list.immediate = 1;
}

}  // namespace

std::span<const FaultInfo> all_faults() noexcept { return kFaultTable; }

const FaultInfo& fault_info(FaultNumber number) noexcept {
  const auto* row = std::lower_bound(kFaultTable.begin(), kFaultTable.end(), number,
                                     [](const FaultInfo& info, FaultNumber wanted) { return info.number < wanted; });
  return row != kFaultTable.end() && row->number == number ? *row : kFaultTable.front();
}

bool is_consequence(const Fault& cause, const Fault& later) noexcept {
  return later.tick >= cause.tick &&
         std::any_of(std::begin(kConsequences), std::end(kConsequences), [&](const Consequence& row) {
           return row.cause == cause.number && row.follows == later.number &&
                  (!row.same_drive || cause.index == later.index);
         });
}

std::optional<std::int32_t> cause_of(const FaultList& list, std::int32_t i) noexcept {
  for (std::int32_t first = 0; first < i; ++first) {  // the list is in the order in which they were found
    if (is_consequence(list.fault[as_index(first)], list.fault[as_index(i)]))
      return cause_of(list, first).value_or(first);
  }
  return std::nullopt;
}

bool allow_retract(const FaultList& faults) noexcept {
  bool allowed = faults.category <= kHold && faults.dropped == 0;
  for (std::int32_t i = 0; i < faults.count; ++i)
    allowed = allowed && fault_info(faults.fault[as_index(i)].number).retract;
  return allowed;
}

bool latch(FaultList& list, const Fault& fault) noexcept {
  if (fault.number == kNone) return false;
  for (std::int32_t i = 0; i < list.count; ++i) {
    Fault& known = list.fault[as_index(i)];
    if (known.number != fault.number || known.index != fault.index) continue;
    if (known.detail == 0) known.detail = fault.detail;
    return false;
  }
  raise(list, fault_info(fault.number));
  if (list.count == FaultList::kCapacity) {
    if (list.dropped < std::numeric_limits<std::uint32_t>::max()) ++list.dropped;
    return false;
  }
  list.fault[as_index(list.count)] = fault;
  ++list.count;
  return true;
}

}  // namespace liana
