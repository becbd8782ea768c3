#include "host/daemon/service_events.hpp"

#include <algorithm>
#include <cstdio>

#include "host/api/request_text.hpp"
#include "host/canopen/emergency.hpp"

namespace liana {
namespace {

std::string drive_name(long long index) { return "drive " + std::to_string(index); }

std::string subject_of(const Fault& fault) {
  if (fault.index < 0) return "";
  return fault.number == FaultNumber::kBusLost ? "bus " + std::to_string(fault.index) : drive_name(fault.index);
}

std::string condition_names(std::uint32_t conditions) {
  std::string text;
  for (std::uint32_t bit = 1; bit != 0; bit <<= 1) {
    if ((conditions & bit) != 0) text += (text.empty() ? "" : ", ") + std::string(condition_name(bit));
  }
  return text;
}

Event fault_event(const Fault& fault) {
  const FaultInfo& info = fault_info(fault.number);
  return {.kind = EventKind::kFault,
          .number = number_of(fault.number),
          .subject = subject_of(fault),
          .values = {{"detail", static_cast<double>(fault.detail)}, {"tick", static_cast<double>(fault.tick)}},
          .text = std::string(info.name) + ": " + info.text};
}

Event faults_without_place_event(std::uint32_t count) {
  return {.kind = EventKind::kFault,
          .values = {{"count", static_cast<double>(count)}},
          .text = std::to_string(count) + " more faults found no place in the list"};
}

bool has(const FaultList& list, const Fault& wanted) {
  return std::any_of(list.fault.begin(), list.fault.begin() + list.count, [&](const Fault& f) {
    return f.number == wanted.number && f.index == wanted.index && f.tick == wanted.tick;
  });
}

}  // namespace

Event booted_event() {
  return {.kind = EventKind::kBoot, .number = number_of(BootEvent::kDone), .text = "all drives are booted"};
}

std::vector<Event> boot_failed_events(const std::vector<BootProblem>& problems) {
  std::vector<Event> events;
  for (const BootProblem& problem : problems)
    events.push_back({.kind = EventKind::kBootProblem,
                      .number = number_of(problem.number),
                      .subject = drive_name(problem.drive),
                      .values = {{"drive", static_cast<double>(problem.drive)}},
                      .text = problem.text});
  events.push_back({.kind = EventKind::kBoot,
                    .number = number_of(BootEvent::kFailed),
                    .text = "booting failed: " + text_of(problems)});
  return events;
}

Event homed_event() {
  return {.kind = EventKind::kHoming, .number = number_of(HomingEvent::kHomed), .text = "the arm is homed"};
}

Event not_homed_event(const std::string& why) {
  return {.kind = EventKind::kHoming, .number = number_of(HomingEvent::kContradicted), .text = "not homed: " + why};
}

Event clear_event(const ClearReport& clear) {
  const std::string result =
      clear.missing == 0 ? "faults cleared" : "faults not cleared, not met: " + condition_names(clear.missing);
  return {.kind = EventKind::kClear,
          .number = clear.missing,
          .values = {{"checked", static_cast<double>(clear.checked)}},
          .text = result + "; checked: " + condition_names(clear.checked)};
}

Event emergency_event(std::size_t drive, std::uint16_t code) {
  char text[96];
  std::snprintf(text, sizeof text, "drive %zu sent emergency 0x%04X: %s", drive, static_cast<unsigned>(code),
                canopen::emergency_text(code));
  return {.kind = EventKind::kEmergency,
          .number = code,
          .subject = drive_name(static_cast<long long>(drive)),
          .values = {{"drive", static_cast<double>(drive)}},
          .text = text};
}

Event verdict_event(std::uint64_t command, const Verdict& verdict) {
  return {.kind = EventKind::kVerdict,
          .number = number_of(verdict.code),
          .subject = number_of(verdict.code) < 200 ? "execution" : "simulation",
          .values = {{"command", static_cast<double>(command)}, {"share", verdict.share}},
          .text = "refused " + std::to_string(command) + ", M_e " + std::to_string(number_of(verdict.code)) + ": " +
                  verdict.text};
}

Event path_event(const PathNews& news) {
  return {.kind = EventKind::kPath,
          .number = number_of(news.what),
          .subject = news.path.hash,
          .values = {{"share", news.path.share}, {"duration_s", news.duration_s}},
          .text = news.text};
}

Event refusal_event(const std::string& client, const std::string& op, const std::string& code, const std::string& why) {
  return {.kind = EventKind::kRefusal,
          .number = number_of(refusal_event(code)),
          .subject = client,
          .text = (op.empty() ? "request" : op) + " refused (" + code + "): " + why};
}

Event owner_event(OwnerEvent what, const std::string& client) {
  const std::string name = "'" + client + "'";
  const std::string text = what == OwnerEvent::kAcquired   ? name + " owns motion"
                           : what == OwnerEvent::kReleased ? name + " released motion: the arm holds"
                                                           : "the owner of motion died: the arm holds";
  return {.kind = EventKind::kOwner, .number = number_of(what), .subject = client, .text = text};
}

Event stands_still_event(const std::string& client, double ttl_s) {
  return {.kind = EventKind::kOwner,
          .number = number_of(OwnerEvent::kStandsStill),
          .subject = client,
          .values = {{"ttl_s", ttl_s}},
          .text = "owner '" + client + "' stands still: no servo_cp for " + text_of(ttl_s) +
                  " s, its ttl_s: the arm holds"};
}

Event stop_event(const StopOrder& order) {
  return {
      .kind = EventKind::kStop, .number = number_of(StopCategory::kStop), .subject = order.by, .text = text_of(order)};
}

Event step_event(int index, const std::string& name) {
  return {.kind = EventKind::kStep,
          .number = index,
          .subject = name,
          .text = "step " + std::to_string(index) + ": " + name};
}

std::vector<Event> FaultWatch::changes(const FaultList& now) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < static_cast<std::size_t>(now.count); ++i) {
    if (!has(seen_, now.fault[i])) events.push_back(fault_event(now.fault[i]));
  }
  if (now.dropped > seen_.dropped) events.push_back(faults_without_place_event(now.dropped - seen_.dropped));
  seen_ = now;
  return events;
}

}  // namespace liana
