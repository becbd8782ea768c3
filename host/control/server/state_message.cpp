#include "host/control/server/state_message.hpp"

#include <array>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/safety/fault_causes.hpp"
#include "host/control/server/host_warning.hpp"
#include "host/control/server/service_events.hpp"
#include "host/control/verification/refusal_table.hpp"

namespace liana::server {

namespace {

Json faults_json(const FaultList& list, const config::BusesConfig& buses, const config::DriveNames& names) {
  Json faults = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(list.count); ++i) {
    const Fault& f = list.fault[i];
    const FaultInfo& info = fault_info(f.number);
    const auto cause = cause_of(list, static_cast<std::int32_t>(i));
    faults.push_back({{"number", static_cast<int>(f.number)},
                      {"name", info.name},
                      {"index", f.index},
                      {"where", place_of(f, buses, names)},
                      {"detail", f.detail},
                      {"tick", f.tick},
                      {"text", info.text},
                      {"remedy", info.remedy},
                      {"cause", cause ? Json(*cause) : Json()}});
  }
  return faults;
}

// Of drives that did not boot: the core has not run, and knows nothing of them. The text is about this drive.
void add_boot_faults(Json& state, const std::vector<realtime::BootProblem>& problems, const config::DriveNames& names) {
  for (const realtime::BootProblem& problem : problems) {
    const FaultInfo& info = fault_info(problem.number);
    state["faults"].push_back({{"number", static_cast<int>(problem.number)},
                               {"name", info.name},
                               {"index", problem.drive},
                               {"where", names.drive(static_cast<std::size_t>(problem.drive))},
                               {"detail", 0},
                               {"tick", state["tick"]},
                               {"text", problem.text},
                               {"remedy", info.remedy},
                               {"cause", nullptr}});
  }
}

Json limits_json(std::uint32_t limits) {
  static constexpr std::array<const char*, 12> kNames{"tip_speed",   "tip_accel",   "theta",         "theta_rate",
                                                      "theta_accel", "cable_speed", "tension_floor", "tension_ceiling",
                                                      "singular",    "gate",        "expired",       "reach"};
  Json names = Json::array();
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (((limits >> i) & 1u) != 0) names.push_back(kNames[i]);
  }
  return names;
}

Json drives_json(const ArmServer& desk, const std::vector<std::uint32_t>& serials, const config::DriveNames& names) {
  Json drives = Json::array();
  for (std::size_t i = 0; i < desk.drive_count(); ++i) {
    const config::DrivePlace place = names.place_of(i);
    Json drive{{"node", place.node},
               {"axis", place.axis},
               {"state", drive_state_name(decode(desk.inputs().drive[i].statusword))},
               {"serial", serials.empty() ? Json() : Json(serials[i])},
               {"torque_permille", desk.inputs().drive[i].torque_permille}};
    desk.add_drive_state(i, drive);
    drives.push_back(std::move(drive));
  }
  return drives;
}

Json buses_json(const config::BusesConfig& buses, const ArmServer& desk) {
  const realtime::TickStatus& report = desk.report();
  const double time_s = static_cast<double>(report.next_tick) * buses.tick_s();
  Json list = Json::array();
  for (std::size_t b = 0; b < buses.buses.size(); ++b) {
    const bus::DriveBusStats& bus = report.bus[b];
    list.push_back(
        {{"name", buses.buses[b].name},
         {"frames", bus.sent + bus.received},
         {"refused", bus.refused},
         {"errors", bus.errors},
         {"state", bus_state_name(bus.state)},
         {"lost", (desk.inputs().lost_bus_mask >> b & 1u) != 0},
         {"worst_load", config::worst_case_load(buses, b)},
         {"measured_load", time_s > 0.0 ? static_cast<double>(bus.bits) / (time_s * buses.buses[b].bitrate) : 0.0}});
  }
  return list;
}

const char* stop_name(StopCategory category) {
  static constexpr std::array<const char*, 4> kNames{"none", "hold", "stop", "off"};
  return kNames[static_cast<std::size_t>(category)];
}

Json stop_json(const EmergencyStop& stop) {
  if (!stop.order()) return nullptr;
  return {{"by", stop.order()->by}, {"reason", stop.order()->reason}, {"tick", stop.order()->tick}};
}

// When the samples were taken (the device's clock), and when the command was released and comes into force (arm time).
Json made_of_json(const Notes& notes, double tick_s) {
  if (!notes.verdict.source_stamp) return nullptr;
  return {{"newest_us", notes.verdict.source_stamp->newest_us},
          {"oldest_us", notes.verdict.source_stamp->oldest_us},
          {"released_s", 1e-6 * static_cast<double>(notes.verdict_us)},
          {"in_force_s", static_cast<double>(notes.verdict.first_tick) * tick_s}};
}

Json verdict_json(const Notes& notes, double tick_s) {
  const LastVerdict& v = notes.verdict;
  const verification::RefusalRow& row = verification::row_of(v.worst.code);
  const verification::Margins& m = v.worst.margins;
  return {{"sequence", v.sequence},
          {"released", v.released},
          {"code", static_cast<int>(v.worst.code)},
          {"name", row.name},
          {"text", v.worst.text},
          {"remedy", row.remedy},
          {"margin", v.worst.margin},
          {"share", v.worst.share},
          {"twin_js_deg", v.twin_js_deg},
          {"stop_js_deg", v.stop_js_deg},
          {"margins", {m.clearance_m, m.joint_deg, m.rate_deg_s, m.tension_N, m.time_us}},
          {"source_stamp", made_of_json(notes, tick_s)}};
}

Json not_homed_json(const NotHomed& found) {
  if (found.is_homed()) return nullptr;
  return {{"reason", not_homed_name(found.reason)}, {"text", found.text}};
}

Json events_json(const std::deque<event::Event>& events) {
  Json list = Json::array();
  for (const event::Event& event : events) list.push_back({{"tick", event.tick}, {"text", event.text}});
  return list;
}

}  // namespace

const char* not_homed_name(NotHomedReason reason) {
  static constexpr std::array<const char*, 6> kNames{
      "homed", "drive_not_heard", "other_pose", "lengths_contradict", "not_settled", "out_of_range"};
  return kNames[static_cast<std::size_t>(reason)];
}

const char* state_name(const ArmServer& desk) {
  if (desk.report().boot == realtime::BootPhase::kBooting) return "BOOTING";
  if (desk.report().boot == realtime::BootPhase::kFailed) return "FAULT";
  return kOperatingStateNames[static_cast<std::size_t>(desk.outputs().state)];
}

Json state_message(const config::BusesConfig& buses, const ArmServer& desk, const Owner& owner, const Notes& notes,
                   const std::deque<event::Event>& events) {
  const realtime::TickStatus& report = desk.report();
  const CycleOutputs& o = desk.outputs();
  Json state{{"op", "state"},
             {"tick", report.next_tick},
             {"time_s", static_cast<double>(report.next_tick) * buses.tick_s()},
             {"state", state_name(desk)},
             {"is_homed", desk.not_homed().is_homed()},
             {"not_homed", not_homed_json(desk.not_homed())},
             {"at_rest", o.at_rest != 0},
             {"owner", owner.name()},
             {"step", notes.step},
             {"operator_says", notes.operator_says},
             {"mission_control", notes.mission_control},
             {"overruns", report.overruns.total()},
             {"refusals", notes.refusals},
             {"refused_motions", notes.refused_motions},
             {"verdict", verdict_json(notes, buses.tick_s())},
             {"drives", drives_json(desk, notes.serials, notes.drive_names)},
             {"buses", buses_json(buses, desk)},
             {"events", events_json(events)},
             {"tool", notes.tool.json()},
             {"stop", stop_json(notes.stop)},
             {"stopping", notes.stopping},
             {"enabling_waits", notes.enabling_waits},
             {"stop_category", stop_name(o.stop_category)},
             {"faults", faults_json(o.faults, buses, notes.drive_names)},
             {"limits", limits_json(o.limits)}};
  if (notes.tick_us) state["tick_us"] = *notes.tick_us;
  desk.add_state(state);
  add_boot_faults(state, notes.boot_problems, notes.drive_names);
  return state;
}

}  // namespace liana::server
