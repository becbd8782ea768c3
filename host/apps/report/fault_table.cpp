#include "host/apps/report/fault_table.hpp"

#include <cmath>

#include "firmware_like/cable/arm/cable_monitor.hpp"
#include "firmware_like/cable/arm/contact_detector.hpp"
#include "firmware_like/cable/arm/friction_estimator.hpp"
#include "firmware_like/cable/arm/tension_monitor.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/supervisor.hpp"
#include "firmware_like/serial/joint_monitor.hpp"
#include "firmware_like/serial/push.hpp"

namespace liana::report {
namespace {

constexpr double kHeartbeatPeriod_s = 0.1;  // of every drive (docs/reference/drives.md)

struct Detection {
  const char* detector;
  int within_ticks;
};

int of_cables(const FaultTimes& times, int ticks) { return times.segments > 0 ? ticks : -1; }

// No default: a number without a detection does not compile.
Detection detection_of(FaultNumber number, const FaultTimes& times) {
  const int heartbeat_period = static_cast<int>(std::ceil(kHeartbeatPeriod_s / times.tick_s));
  switch (number) {
    case FaultNumber::kNone:
      break;
    case FaultNumber::kCommandInvalid:
      return {"controller: each value of a released command when it takes force", 0};
    case FaultNumber::kTicksLost:
      return {"watchdog: deadlines lost in a row, more than 2", 1};
    case FaultNumber::kJointOutOfRange:
      return {"serial arm: encoder more than 1 deg beyond the joint's range, in a row", serial::kRangeDebounceTicks};
    case FaultNumber::kJointJump:
      return {"serial arm: encoder against the tick before, over three times the joint's rate", 1};
    case FaultNumber::kWristSensorLost:
      return {
          "push: no new sample of the wrist sensor, or one that is saturated, failed or no number (at once); the very "
          "same numbers (after wrist_still_samples of the table)",
          serial::kWristSilentTicks + 1};
    case FaultNumber::kPushOverload:
      return {"push: force felt at the wrist or torque of a joint over the most that a push may, in a row",
              serial::kOverloadTicks + 1};
    case FaultNumber::kDriveMissing:
      return {"watchdog: age of the drive's heartbeat, more than 0.3 s",
              heartbeat_age_ticks(times.tick_s) + heartbeat_period};
    case FaultNumber::kDriveSilent:
      return {"watchdog: age of the drive's report, more than 2 ticks", kFeedbackAgeTicks + 1};
    case FaultNumber::kDriveFault:
      return {"watchdog: statusword says fault", 1};
    case FaultNumber::kDriveLeftOperation:
      return {"watchdog: statusword of a drive that should be in Operation enabled", 1};
    case FaultNumber::kDriveEnableTimeout:
      return {"supervisor: time in a step of enabling (a ramp of tension has 15000 ticks)",
              static_cast<int>(patience(times.tick_s).powering) + 1};
    case FaultNumber::kFollowingError:
      return {"watchdog: sent target less reported place, over the window, in a row", kFollowingDebounceTicks};
    case FaultNumber::kDriveNotOperational:
      return {"watchdog: NMT state in the drive's heartbeat or boot-up", heartbeat_period};
    case FaultNumber::kDriveStopTimeout:
      return {"supervisor: time until every drive confirms that it is off",
              static_cast<int>(patience(times.tick_s).off_budget) + 1};
    case FaultNumber::kNodeTwice:
      return {"host: two reports that differ in one tick, or a command that is not ours, in a row", kTwiceTicks};
    case FaultNumber::kBusLost:
      return {"interface down or in bus-off (1 tick), or no drive of the bus is heard", kFeedbackAgeTicks + 1};
    case FaultNumber::kCableSlack:
      return {"watchdog: motor tension under the floor, in a row", of_cables(times, cable::kSlackDebounceTicks)};
    case FaultNumber::kCableOverload:
      return {"watchdog: motor tension over the hard limit, in a row", of_cables(times, cable::kOverloadDebounceTicks)};
    case FaultNumber::kTensionAlarm:
      return {"watchdog: motor tension over the alarm limit, in a row", of_cables(times, cable::kAlarmDebounceTicks)};
    case FaultNumber::kHomingImplausible:
      return {
          "cable watch: the part of a segment's lengths that no two angles explain, against its value when the arm was "
          "enabled, in a row",
          of_cables(times, cable::kContradictionTicks + times.segments - 1)};
    case FaultNumber::kCableSlip:
      return {"cable watch: tension and length of a cable against the tick before, over the limit, and still there",
              of_cables(times, cable::kJumpConfirmTicks)};
    case FaultNumber::kCableBreak:
      return {"watchdog: motor tension under the floor while its 20 ms low-pass is not, in a row",
              of_cables(times, cable::kBreakDebounceTicks)};
    case FaultNumber::kTensionScatters:
      return {"cable watch: the same as 5005, but back again, three times (in a row: 4 ticks)",
              of_cables(times, cable::kScatterReversals + 1)};
    case FaultNumber::kBodyContact:
      return {
          "contact watch: torques that cables, friction, inertia and a push of up to 3 N at the tip do not explain, "
          "low-passed over 0.6 s and in their own deviations, in a row",
          of_cables(times, static_cast<int>(cable::kFrictionTicks) * 2 * times.segments * (cable::kContactSweeps + 1))};
    case FaultNumber::kFrictionNotAsDeclared:
      return {
          "friction watch: mu found from the balance of torques, less twice its uncertainty, over what can be "
          "planned for",
          -1};
    case FaultNumber::kGateRefused:
      return {"gate: every command before it is sent", 0};
  }
  return {"", -1};
}

std::string stops_by(const FaultInfo& info) {
  constexpr const char* kNames[] = {"none", "hold", "stop", "off"};
  return std::string(kNames[static_cast<std::size_t>(info.category)]) + (info.immediate ? " at once" : "");
}

}  // namespace

std::vector<FaultRow> fault_rows(const FaultTimes& times) {
  std::vector<FaultRow> rows;
  for (const FaultInfo& info : all_faults().subspan(1)) {
    const Detection detection = detection_of(info.number, times);
    rows.push_back({info, detection.detector, detection.within_ticks, stops_by(info)});
  }
  return rows;
}

std::string markdown_of(const std::vector<FaultRow>& rows) {
  std::string text =
      "| number | name | detected by | within ticks | stops by | retreat | what it means | what to do |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const FaultRow& row : rows) {
    text += "| " + std::to_string(static_cast<int>(row.info.number)) + " | " + row.info.name + " | " + row.detector +
            " | " + (row.within_ticks < 0 ? "" : std::to_string(row.within_ticks)) + " | " + row.stops_by + " | " +
            (row.info.retreat ? "yes" : "no") + " | " + row.info.text + " | " + row.info.remedy + " |\n";
  }
  return text;
}

}  // namespace liana::report
