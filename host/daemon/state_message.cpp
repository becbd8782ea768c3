#include "host/daemon/state_message.hpp"

#include <array>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/drive/pdo.hpp"
#include "firmware_like/safety/faults.hpp"
#include "host/config/theta_numbers.hpp"
#include "host/daemon/homing.hpp"
#include "host/daemon/host_trouble.hpp"

namespace liana {

namespace {

constexpr double kDegrees = 57.29577951308232;

Json pose_json(const Pose& p) {
  return {p.position_m[0], p.position_m[1], p.position_m[2], p.quaternion[0],
          p.quaternion[1], p.quaternion[2], p.quaternion[3]};
}

Json first(const cable::CableVector& values, std::int32_t count) {
  return Json(std::vector<double>(values.begin(), values.begin() + count));
}

Json nodes_json(const cable::RobotTable& table, const cable::Outputs& outputs) {
  Json nodes = Json::array();
  for (std::size_t m = 0; m < static_cast<std::size_t>(table.segment_count); ++m)
    nodes.push_back(outputs.node_command_m[m]);
  return nodes;
}

Json faults_json(const FaultList& list) {
  Json faults = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(list.count); ++i) {
    const Fault& f = list.fault[i];
    const FaultInfo& info = fault_info(f.number);
    faults.push_back({{"number", static_cast<int>(f.number)},
                      {"name", info.name},
                      {"index", f.index},
                      {"detail", f.detail},
                      {"tick", f.tick},
                      {"text", info.text},
                      {"remedy", info.remedy}});
  }
  return faults;
}

// Of drives that did not boot: the core has not run, and knows nothing of them. The text is about this drive.
void add_boot_faults(Json& state, const std::vector<BootProblem>& problems) {
  for (const BootProblem& problem : problems) {
    const FaultInfo& info = fault_info(problem.number);
    state["faults"].push_back({{"number", static_cast<int>(problem.number)},
                               {"name", info.name},
                               {"index", problem.drive},
                               {"detail", 0},
                               {"tick", state["tick"]},
                               {"text", problem.text},
                               {"remedy", info.remedy}});
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

Json drives_json(const cable::RobotTable& table, const CycleReport& report, const std::vector<std::uint32_t>& serials) {
  const cable::CableVector position_m = paid_out_m(table, report.inputs),
                           tension_N = reported_tension_N(table, report.inputs);
  Json drives = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.cable_count()); ++i) {
    drives.push_back({{"node", node_of_drive(i)},
                      {"state", drive_state_name(decode(report.inputs.drive[i].statusword))},
                      {"position_m", position_m[i]},
                      {"tension_N", tension_N[i]},
                      {"serial", serials.empty() ? Json() : Json(serials[i])}});
  }
  return drives;
}

Json buses_json(const BusesConfig& buses, const CycleReport& report) {
  const double time_s = static_cast<double>(report.next_tick) * buses.tick_s();
  Json list = Json::array();
  for (std::size_t b = 0; b < buses.buses.size(); ++b) {
    const DriveBusStats& bus = report.bus[b];
    list.push_back(
        {{"name", buses.buses[b].name},
         {"frames", bus.sent + bus.received},
         {"refused", bus.refused},
         {"errors", bus.errors},
         {"state", bus_state_name(bus.state)},
         {"lost", (report.inputs.lost_bus_mask >> b & 1u) != 0},
         {"worst_load", worst_case_load(buses, b)},
         {"measured_load", time_s > 0.0 ? static_cast<double>(bus.bits) / (time_s * buses.buses[b].bitrate) : 0.0}});
  }
  return list;
}

const char* stop_name(StopCategory category) {
  static constexpr std::array<const char*, 4> kNames{"none", "hold", "stop", "off"};
  return kNames[static_cast<std::size_t>(category)];
}

const char* device_name(DeviceKind kind) {
  static constexpr std::array<const char*, 3> kNames{"none", "vr", "hand"};
  return kNames[static_cast<std::size_t>(kind)];
}

Json stop_json(const EmergencyStop& stop) {
  if (!stop.order()) return nullptr;
  return {{"by", stop.order()->by}, {"reason", stop.order()->reason}, {"tick", stop.order()->tick}};
}

Json verdict_json(const cable::RobotTable& table, const LastVerdict& v) {
  return {{"sequence", v.sequence}, {"released", v.released},   {"code", static_cast<int>(v.worst.code)},
          {"text", v.worst.text},   {"margin", v.worst.margin}, {"twin_js_deg", degrees(table, v.twin_theta_rad)}};
}

void add_arm(Json& state, const cable::RobotTable& table, const CycleReport& report) {
  const cable::Outputs& o = report.outputs;
  state["measured_js_deg"] = degrees(table, o.theta_measured_rad);
  state["setpoint_js_deg"] = degrees(table, o.theta_command_rad);
  state["measured_cp"] = pose_json(tip_pose(table, arm_trig(table, o.theta_measured_rad)));
  state["setpoint_cp"] = pose_json(o.tip_command);
  state["goal_cp"] = pose_json(o.tip_goal);
  state["node_m"] = nodes_json(table, o);
  state["held"] = theta_numbers(o.held_mask);
  state["held_at_target"] = o.held_at_target != 0;
  state["at_rest"] = o.at_rest != 0;
  state["tension_N"] = first(o.tension_measured_N, table.cable_count());
  state["stop_category"] = stop_name(o.stop_category);
  state["ik"] = {{"outcome", ik_outcome_name(o.ik_outcome)},
                 {"residual_m", {o.ik_residual[0], o.ik_residual[1], o.ik_residual[2]}},
                 {"residual_rad", {o.ik_residual[3], o.ik_residual[4], o.ik_residual[5]}}};
  state["faults"] = faults_json(o.faults);
  state["limits"] = limits_json(o.limits);
}

}  // namespace

Json degrees(const cable::RobotTable& table, const cable::ThetaVector& theta_rad) {
  Json list = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i)
    list.push_back(theta_rad[i] * kDegrees);
  return list;
}

const char* state_name(const CycleReport& report) {
  static constexpr std::array<const char*, 5> kNames{"DISABLED", "ENABLING", "ENABLED", "STOPPING", "FAULT"};
  if (report.boot == BootPhase::kBooting) return "BOOTING";
  if (report.boot == BootPhase::kFailed) return "FAULT";
  return kNames[static_cast<std::size_t>(report.outputs.state)];
}

Json state_message(const cable::RobotTable& table, const BusesConfig& buses, const CycleReport& report,
                   const CableArbiter& arbiter, const Owner& owner, const Notes& notes) {
  const cable::Outputs& o = report.outputs;
  const DeviceUse& device = arbiter.device().in_use();
  const bool moving = o.state == OperatingState::kEnabled && (o.at_rest == 0 || o.held_at_target == 0);
  Json state{
      {"op", "state"},
      {"tick", report.next_tick},
      {"time_s", static_cast<double>(report.next_tick) * table.tick_s},
      {"state", state_name(report)},
      {"is_homed", notes.homed},
      {"is_busy", arbiter.is_busy() || moving},
      {"retracted", arbiter.has_retracted()},
      {"owner", owner.name()},
      {"device", device_name(device.kind)},
      {"device_engaged", arbiter.device().engaged()},
      {"device_reason", arbiter.device().reason()},
      {"device_samples", arbiter.device().samples()},
      {"mapping", {{"scale", device.mapping.scale}, {"rotation_scale", device.mapping.rotation_scale}}},
      {"step", notes.step},
      {"operator_says", notes.operator_says},
      {"overruns", report.overruns.total()},
      {"refusals", notes.refusals},
      {"verdict", verdict_json(table, notes.verdict)},
      {"drives", drives_json(table, report, notes.serials)},
      {"buses", buses_json(buses, report)},
      {"events", notes.events},
      {"stop", stop_json(notes.stop)},
      {"stopping", notes.stopping},
      {"shape",
       {{"missing_m", notes.shape.missing_m}, {"settled", notes.shape.settled}, {"searching", notes.shape.searching}}},
      {"planar_segments", notes.planar_segments}};
  add_arm(state, table, report);
  add_boot_faults(state, notes.boot_problems);
  return state;
}

}  // namespace liana
