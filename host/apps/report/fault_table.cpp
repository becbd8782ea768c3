#include "host/apps/report/fault_table.hpp"

#include <array>
#include <cmath>
#include <span>

#include "firmware_like/cable/arm/cable_monitor.hpp"
#include "firmware_like/cable/arm/contact_detector.hpp"
#include "firmware_like/cable/arm/friction_estimator.hpp"
#include "firmware_like/cable/arm/load_cell.hpp"
#include "firmware_like/cable/arm/tension_monitor.hpp"
#include "firmware_like/math/enumerators.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/supervisor.hpp"
#include "firmware_like/serial/joint_monitor.hpp"
#include "firmware_like/serial/push.hpp"

namespace liana::report {
namespace {

constexpr double kHeartbeatPeriod_s = 0.1;  // of every drive (docs/reference/drives.md)

using enum FaultNumber;
using WithinTicks = int (*)(const FaultTimes&);

struct Detection {
  FaultNumber number = kNone;
  const char* detector = "";
  WithinTicks within_ticks = nullptr;
};

int heartbeat_period(const FaultTimes& times) { return static_cast<int>(std::ceil(kHeartbeatPeriod_s / times.tick_s)); }

template <int kTicks>
int ticks(const FaultTimes&) {
  return kTicks;
}

template <int kTicks>
int ticks_of_cables(const FaultTimes& times) {
  return times.segments > 0 ? kTicks : -1;
}

// In ascending order, as all_faults(). A new number without a row does not compile.
constexpr std::array<Detection, count_enumerators<FaultNumber, 1000>() - 1> kDetections{{
    {kCommandInvalid, "controller: each value of an issued command when it takes force", ticks<0>},
    {kTicksLost, "drive link monitor: deadlines lost in a row, more than 2", ticks<1>},
    {kJointOutOfRange, "serial arm: encoder more than 1 deg beyond the joint's range, in a row",
     ticks<serial::kRangeDebounceTicks>},
    {kJointJump,
     "serial arm, and slide and roll of a base: encoder against the tick before, over three times the axis' rate and "
     "what its servo lags",
     ticks<1>},
    {kWristSensorLost,
     "insertion: no new sample of the wrist sensor, or one that is saturated, failed or no number (at once); equal "
     "samples (after wrist_still_samples of the table)",
     ticks<serial::kWristSilentTicks + 1>},
    {kPushOverload, "insertion: force at the wrist or torque of a joint over the maximum of an insertion, in a row",
     ticks<serial::kOverloadTicks + 1>},
    {kDriveMissing, "drive link monitor: age of the drive's heartbeat, more than 0.3 s",
     [](const FaultTimes& times) { return heartbeat_age_ticks(times.tick_s) + heartbeat_period(times); }},
    {kDriveSilent, "drive link monitor: age of the drive's report, more than 2 ticks", ticks<kFeedbackAgeTicks + 1>},
    {kDriveFault, "drive link monitor: statusword reports a fault", ticks<1>},
    {kDriveLeftOperation, "drive link monitor: statusword of a drive that should be in Operation enabled", ticks<1>},
    {kDriveEnableTimeout, "supervisor: time in a step of enabling (a ramp of tension has 15000 ticks)",
     [](const FaultTimes& times) { return static_cast<int>(patience(times.tick_s).powering) + 1; }},
    {kFollowingError, "drive link monitor: sent target minus reported position, over the window, in a row",
     ticks<kFollowingDebounceTicks>},
    {kDriveNotOperational, "drive link monitor: NMT state in the drive's heartbeat or boot-up", heartbeat_period},
    {kDriveStopTimeout, "supervisor: time until every drive confirms that it is off",
     [](const FaultTimes& times) { return static_cast<int>(patience(times.tick_s).off_budget) + 1; }},
    {kNodeTwice, "host: two reports that differ in one tick, or a command that is not ours, in a row",
     ticks<kTwiceTicks>},
    {kDriveOtherMode, "host: 6061 of a drive in Operation enabled, asked by SDO once in 8 ticks; the answer takes one",
     ticks<kModeRoundTicks + 2>},
    {kBusLost, "interface down or in bus-off (1 tick), or no drive of the bus sends", ticks<kFeedbackAgeTicks + 1>},
    {kCableSlack, "tension monitor: motor tension under the floor, in a row",
     ticks_of_cables<cable::kSlackDebounceTicks>},
    {kCableOverload, "tension monitor: motor tension, or force of a base's drive, over the hard limit, in a row",
     ticks_of_cables<cable::kOverloadDebounceTicks>},
    {kTensionAlarm, "tension monitor: motor tension over the alarm limit, in a row",
     ticks_of_cables<cable::kAlarmDebounceTicks>},
    {kHomingImplausible,
     "cable monitor: the part of a segment's lengths that no two angles explain, against its value when the arm was "
     "enabled, in a row",
     [](const FaultTimes& times) { return times.segments > 0 ? cable::kContradictionTicks + times.segments - 1 : -1; }},
    {kCableSlip,
     "cable monitor: change of a cable's tension and length since the tick before, over the limit, and still there",
     ticks_of_cables<cable::kJumpConfirmTicks>},
    {kCableBreak, "tension monitor: motor tension under the floor while its 20 ms low-pass is not, in a row",
     ticks_of_cables<cable::kBreakDebounceTicks>},
    {kTensionScatters, "cable monitor: a change as for 5005 and back, three times (in a row: 4 ticks)",
     ticks_of_cables<cable::kScatterReversals + 1>},
    {kBodyContact,
     "contact detector: torques that cables, friction, inertia and a force of up to 3 N at the tip do not explain, "
     "low-passed over 0.6 s, relative to their standard deviations, in a row; of a base's drive (5 ticks): force "
     "beyond "
     "load, friction and a push at the tip",
     [](const FaultTimes& times) {
       return times.segments > 0
                  ? static_cast<int>(cable::kFrictionTicks) * 2 * times.segments * (cable::kContactSweeps + 1)
                  : -1;
     }},
    {kFrictionNotAsDeclared,
     "friction estimator: mu from the balance of torques, minus twice its uncertainty, over what can be "
     "planned for",
     ticks<-1>},
    {kLoadCellLost, "load cell: no reading for more than 2 ticks, or one out of range, in a row",
     ticks_of_cables<cable::kLoadCellLostTicks + kFeedbackAgeTicks>},
    {kLoadCellContradicts, "load cell: further from the drive's torque than load_cell.agree_N, in a row",
     ticks_of_cables<cable::kLoadCellDoubtTicks>},
    {kGateRefused, "gate: every command before it is sent", ticks<0>},
}};

constexpr bool is_complete() {
  FaultNumber last = kNone;
  for (const Detection& each : kDetections) {
    if (each.number <= last || each.detector[0] == '\0' || each.within_ticks == nullptr) return false;
    last = each.number;
  }
  return true;
}
static_assert(is_complete(), "detections: every number but none once, ascending, with detector and ticks");

std::string stops_by(const FaultInfo& info) {
  constexpr const char* kNames[] = {"none", "hold", "stop", "off"};
  return std::string(kNames[static_cast<std::size_t>(info.category)]) + (info.immediate ? " at once" : "");
}

}  // namespace

std::vector<FaultRow> fault_rows(const FaultTimes& times) {
  std::vector<FaultRow> rows;
  const std::span<const FaultInfo> faults = all_faults().subspan(1);
  for (std::size_t i = 0; i < faults.size(); ++i)
    rows.push_back({faults[i], kDetections[i].detector, kDetections[i].within_ticks(times), stops_by(faults[i])});
  return rows;
}

std::string markdown_of(const std::vector<FaultRow>& rows) {
  std::string text =
      "| number | name | detected by | within ticks | stops by | retract | what it means | what to do |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const FaultRow& row : rows) {
    text += "| " + std::to_string(static_cast<int>(row.info.number)) + " | " + row.info.name + " | " + row.detector +
            " | " + (row.within_ticks < 0 ? "" : std::to_string(row.within_ticks)) + " | " + row.stops_by + " | " +
            (row.info.retract ? "yes" : "no") + " | " + row.info.text + " | " + row.info.remedy + " |\n";
  }
  return text;
}

}  // namespace liana::report
