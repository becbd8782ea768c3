#include "host/control/server/service_events.hpp"

#include <algorithm>
#include <cstdio>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/fault_causes.hpp"
#include "host/api/server/request_text.hpp"
#include "host/base/event/fault_groups.hpp"
#include "host/control/verification/refusal_table.hpp"
#include "host/drives/canopen/emergency.hpp"

namespace liana::server {
namespace {

std::string condition_names(std::uint32_t conditions) {
  std::string text;
  for (std::uint32_t bit = 1; bit != 0; bit <<= 1) {
    if ((conditions & bit) != 0) text += (text.empty() ? "" : ", ") + std::string(condition_name(bit));
  }
  return text;
}

event::Event fault_event(const Fault& fault, FaultNumber cause, const std::string& place) {
  const FaultInfo& info = fault_info(fault.number);
  return {.kind = event::EventKind::kFault,
          .number = event::number_of(fault.number),
          .subject = place,
          .values = {{"detail", static_cast<double>(fault.detail)},
                     {"tick", static_cast<double>(fault.tick)},
                     {"cause", static_cast<double>(event::number_of(cause))}},
          .text = std::string(info.text) + " " + info.remedy + " [" + std::to_string(event::number_of(fault.number)) +
                  " " + info.name + "]"};
}

event::Event faults_without_place_event(std::uint32_t count) {
  return {.kind = event::EventKind::kFault,
          .values = {{"count", static_cast<double>(count)}},
          .text = std::to_string(count) + " more faults found no place in the list"};
}

bool has(const FaultList& list, const Fault& wanted) {
  return std::any_of(list.fault.begin(), list.fault.begin() + list.count, [&](const Fault& f) {
    return f.number == wanted.number && f.index == wanted.index && f.tick == wanted.tick;
  });
}

}  // namespace

std::string place_of(const Fault& fault, const config::BusesConfig& buses, const config::DriveNames& names) {
  if (fault.index < 0) return "";
  const auto index = static_cast<std::size_t>(fault.index);
  return fault.number == FaultNumber::kBusLost ? "bus " + buses.buses.at(index).name : names.drive(index);
}

event::Event booted_event() {
  return {.kind = event::EventKind::kBoot,
          .number = event::number_of(event::BootEvent::kDone),
          .text = "all drives are booted"};
}

event::Event unwatched_event(const std::string& what) {
  return {.kind = event::EventKind::kBoot, .number = event::number_of(event::BootEvent::kUnwatched), .text = what};
}

event::Event boot_goes_on_event() {
  return {.kind = event::EventKind::kBoot,
          .number = event::number_of(event::BootEvent::kGoesOn),
          .text = "booting goes on: a drive has come, or is asked for again"};
}

std::vector<event::Event> boot_failed_events(const std::vector<realtime::BootProblem>& problems,
                                             const config::DriveNames& names) {
  std::vector<event::Event> events;
  events.reserve(problems.size());
  for (const realtime::BootProblem& problem : problems) {
    events.push_back({.kind = event::EventKind::kBootProblem,
                      .number = event::number_of(problem.number),
                      .subject = names.drive(static_cast<std::size_t>(problem.drive)),
                      .values = {{"drive", problem.drive + 1.0}},
                      .text = problem.text});
  }
  events.push_back({.kind = event::EventKind::kBoot,
                    .number = event::number_of(event::BootEvent::kFailed),
                    .text = "booting failed: " + realtime::text_of(problems)});
  return events;
}

event::Event homed_event() {
  return {.kind = event::EventKind::kHoming,
          .number = event::number_of(event::HomingEvent::kHomed),
          .text = "the arm is homed"};
}

event::Event not_homed_event(const std::string& why) {
  return {.kind = event::EventKind::kHoming,
          .number = event::number_of(event::HomingEvent::kContradicted),
          .text = "not homed: " + why};
}

std::string why_enabling_waits(const ArmServer& desk, const config::DriveNames& names) {
  std::string text;
  for (std::size_t i = 0; i < desk.drive_count(); ++i) {
    const DriveState state = decode(desk.inputs().drive[i].statusword);
    if (state == DriveState::kOperationEnabled) continue;
    text += (text.empty() ? "" : ", ") + names.drive(i) + " is in " + drive_state_name(state);
  }
  return text.empty() ? desk.why_not_taut() : text + ", needed operation_enabled";
}

std::string drives_that_keep(const ArmServer& desk, const config::DriveNames& names) {
  std::vector<std::string> silent, stopped, in_fault;
  for (std::size_t i = 0; i < desk.drive_count(); ++i) {
    const DriveFeedback& drive = desk.inputs().drive[i];
    const DriveState state = decode(drive.statusword);
    if (drive.feedback_age_ticks > kFeedbackAgeTicks)
      silent.push_back(names.drive(i));
    else if (drive.operational == 0)
      stopped.push_back(names.drive(i));
    else if (state == DriveState::kFault || state == DriveState::kFaultReactionActive)
      in_fault.push_back(names.drive(i));
  }
  std::string text;
  const auto add = [&](const std::vector<std::string>& places, const char* what) {
    if (!places.empty()) text += "; " + event::places_text(places) + what;
  };
  add(silent, ": no feedback");
  add(stopped, ": not operational");
  add(in_fault, ": in fault");
  return text;
}

event::Event clear_event(const ClearResult& clear, const std::string& keeps) {
  const std::string result =
      clear.missing == 0 ? "faults cleared" : "faults not cleared, not met: " + condition_names(clear.missing) + keeps;
  return {.kind = event::EventKind::kClear,
          .number = clear.missing,
          .values = {{"checked", static_cast<double>(clear.checked)}},
          .text = result + "; checked: " + condition_names(clear.checked)};
}

event::Event emergency_event(std::size_t drive, std::uint16_t code, const config::DriveNames& names) {
  const std::string name = names.drive(drive);
  char text[128];
  std::snprintf(text, sizeof text, "%s sent emergency 0x%04X: %s", name.c_str(), static_cast<unsigned>(code),
                canopen::emergency_text(code));
  return {.kind = event::EventKind::kEmergency,
          .number = code,
          .subject = name,
          .values = {{"drive", static_cast<double>(drive + 1)}},
          .text = text};
}

event::Event verdict_event(std::uint64_t command, const verification::Verdict& verdict) {
  const verification::RefusalRow& row = verification::row_of(verdict.code);
  return {.kind = event::EventKind::kVerdict,
          .number = event::number_of(verdict.code),
          .subject = event::number_of(verdict.code) < 200 ? "execution" : "simulation",
          .values = {{"command", static_cast<double>(command)}, {"share", verdict.share}},
          .text = "refused: " + verdict.text + ". " + row.remedy + " [" +
                  std::to_string(event::number_of(verdict.code)) + " " + row.name + ", command " +
                  std::to_string(command) + "]"};
}

event::Event path_event(const arbiter::PathEvents& news) {
  return {.kind = event::EventKind::kPath,
          .number = event::number_of(news.what),
          .subject = news.path.hash,
          .values = {{"share", news.path.share}, {"duration_s", news.duration_s}},
          .text = news.text};
}

event::Event way_event(const arbiter::RetractEvents& news) {
  return {.kind = event::EventKind::kRetract,
          .number = event::number_of(news.what),
          .values = {{"points", static_cast<double>(news.points)}, {"distance_m", news.distance_m}},
          .text = news.text};
}

event::Event refusal_event(const std::string& client, const std::string& code, const std::string& text) {
  return {.kind = event::EventKind::kRefusal,
          .number = event::number_of(event::refusal_event(code)),
          .subject = client,
          .text = text};
}

event::Event refusal_event(const std::string& client, const std::string& op, const std::string& code,
                           const std::string& why) {
  return refusal_event(client, code, (op.empty() ? "request" : op) + " refused (" + code + "): " + why);
}

event::Event owner_event(event::OwnerEvent what, const std::string& client) {
  const std::string name = "'" + client + "'";
  const std::string text = what == event::OwnerEvent::kAcquired   ? name + " owns motion"
                           : what == event::OwnerEvent::kReleased ? name + " gave back motion: the arm holds"
                                                                  : "the owner of motion died: the arm holds";
  return {.kind = event::EventKind::kOwner, .number = event::number_of(what), .subject = client, .text = text};
}

event::Event taken_event(const Claimant& from, const Claimant& by, const std::string& why) {
  return {.kind = event::EventKind::kOwner,
          .number = event::number_of(event::OwnerEvent::kTaken),
          .subject = from.name,
          .text = by.text() + " took motion from " + from.text() + ", " + why + ": the arm holds"};
}

event::Event stands_still_event(const std::string& client, double ttl_s) {
  return {.kind = event::EventKind::kOwner,
          .number = event::number_of(event::OwnerEvent::kStandsStill),
          .subject = client,
          .values = {{"ttl_s", ttl_s}},
          .text = "owner '" + client + "' stands still: no servo_cp for " + api::text_of(ttl_s) +
                  " s, its ttl_s: the arm holds"};
}

event::Event stop_event(const StopOrder& order) {
  return {.kind = event::EventKind::kStop,
          .number = event::number_of(StopCategory::kStop),
          .subject = order.by,
          .text = text_of(order)};
}

event::Event step_event(int index, const std::string& name, const std::string& waits, const std::string& after) {
  return {.kind = event::EventKind::kStep,
          .number = index,
          .subject = name,
          .text = "step " + std::to_string(index) + ": " + name + (waits.empty() ? "" : " waits, " + waits) +
                  (after.empty() ? "" : "; what ended the step before: " + after)};
}

event::Event last_step_event(const std::string& after) {
  return {.kind = event::EventKind::kStep, .text = "steps over; what ended the last: " + after};
}

std::vector<event::Event> FaultMonitor::changes(const FaultList& now, const config::BusesConfig& buses,
                                                const config::DriveNames& names) {
  std::vector<event::Event> events;
  for (std::size_t i = 0; i < static_cast<std::size_t>(now.count); ++i) {
    if (has(seen_, now.fault[i])) continue;
    const auto cause = cause_of(now, static_cast<std::int32_t>(i));
    events.push_back(fault_event(now.fault[i],
                                 cause ? now.fault[static_cast<std::size_t>(*cause)].number : FaultNumber::kNone,
                                 place_of(now.fault[i], buses, names)));
  }
  if (now.dropped > seen_.dropped) events.push_back(faults_without_place_event(now.dropped - seen_.dropped));
  seen_ = now;
  return events;
}

}  // namespace liana::server
