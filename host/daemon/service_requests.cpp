// What each request of docs/api.md does.
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/api/fields.hpp"
#include "host/api/request_error.hpp"
#include "host/daemon/device_messages.hpp"
#include "host/daemon/service.hpp"
#include "host/daemon/timing_message.hpp"

namespace liana {

namespace {
// Limit of a theta, free of what the way through radians left of it.
double limit_deg(const cable::RobotTable& table, std::size_t theta) {
  return std::round(table.segment[theta / 2].theta_limit_rad / kDegree * 1e9) / 1e9;
}
}  // namespace

const std::map<std::string, Service::Handler>& Service::handlers() {
  static const std::map<std::string, Handler> kHandlers{{"acquire", &Service::on_acquire},
                                                        {"release", &Service::on_release},
                                                        {"state_command", &Service::on_state_command},
                                                        {"move_jp", &Service::on_move_jp},
                                                        {"move_cp", &Service::on_move_cp},
                                                        {"servo_cp", &Service::on_servo_cp},
                                                        {"hold_theta", &Service::on_hold_theta},
                                                        {"shape", &Service::on_shape},
                                                        {"use_device", &Service::on_use_device},
                                                        {"retract", &Service::on_retract},
                                                        {"hold", &Service::on_hold},
                                                        {"tool", &Service::on_tool},
                                                        {"stop", &Service::on_stop},
                                                        {"shutdown", &Service::on_shutdown},
                                                        {"announce", &Service::on_announce},
                                                        {"operator_says", &Service::on_operator_says},
                                                        {"device", &Service::on_device},
                                                        {"camera", &Service::on_camera},
                                                        {"timing", &Service::on_timing}};
  return kHandlers;
}

Json Service::handle(const ClientInfo& client, const Json& request) {
  const auto found = handlers().find(text_field(request, "op", 32));
  if (found == handlers().end()) throw RequestError("bad_request", "unknown op " + request["op"].dump());
  return (this->*found->second)(client, request);
}

Json Service::welcome(const ClientInfo&) {
  return {{"op", "welcome"},
          {"time_mode", time_mode_name(config_.time_mode)},
          {"period_s", config_.robot.table.tick_s},
          {"interval_ticks", config_.robot.table.interval_ticks},
          {"config_hash", config_hash(config_.robot, config_.scene, config_.buses)},
          {"robot", Json::parse(config_.robot.canonical_json)},
          {"scene", Json::parse(config_.scene.canonical_json)},
          {"buses", Json::parse(config_.buses.canonical_json)}};
}

void Service::gone(const ClientInfo& client, const std::string& why) {
  note(std::string(role_name(client.role)) + " '" + client.name + "' is gone (" + why + ")");
  if (owner_.gone(client.id)) drop_motion("the owner of motion died");
  if (config_.ends_with_mission && client.role == Role::kMission) mission_end_tick_ = tick();
}

Json Service::on_acquire(const ClientInfo& client, const Json&) {
  if (client.role != Role::kMission && client.role != Role::kClient) {
    throw RequestError("not_owner",
                       "role '" + std::string(role_name(client.role)) + "' cannot own motion; mission and client can");
  }
  owner_.acquire(client.id, static_cast<std::uint32_t>(client.role) + 1, client.name);
  if (client.role == Role::kClient) notes_.stop.release();  // a mission may have asked before it saw the stop
  return Json::object();
}

Json Service::on_release(const ClientInfo& client, const Json&) {
  owner_.release(client.id);
  drop_motion("'" + client.name + "' released motion");
  return Json::object();
}

Json Service::on_state_command(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  const std::string command = text_field(request, "command", 16);
  if (boot_seen_ == BootPhase::kFailed) throw RequestError("fault", "booting failed: " + text_of(notes_.boot_problems));
  if (boot_seen_ == BootPhase::kBooting) throw RequestError("busy", "the drives are still booting");
  if (command == "enable") {
    if (const auto& stop = notes_.stop.order()) {
      throw RequestError("refused",
                         text_of(*stop) + " is in force: a client has to acquire motion anew, or to send clear");
    }
    if (stop_tick_ == tick()) throw RequestError("refused", "a stop was asked for in the same command interval");
    if (now().faults.count > 0) throw RequestError("fault", "a fault is latched: clear it first");
    if (shutdown_tick_) throw RequestError("refused", "lianad is stopping");
    require_homed();
    this->request(Request::kEnable);
  } else if (command == "disable") {
    this->request(Request::kDisable);
  } else if (command == "clear") {
    notes_.stop.release();
    this->request(Request::kClear);
  } else if (command == "home") {
    require_homed();  // encoders are absolute: nothing has to be done
  } else {
    throw RequestError("bad_request", "command '" + command + "': allowed enable, disable, clear, home");
  }
  return Json::object();
}

void Service::require_homed() const {
  if (!homing_.is_homed()) throw RequestError("refused", "not homed: " + homing_.why_not());
}

Json Service::on_move_jp(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  const cable::RobotTable& table = config_.robot.table;
  const auto count = static_cast<std::size_t>(table.theta_count());
  const std::vector<double> goal_deg = numbers_field(request, "goal_deg", count, -180.0, 180.0);
  const double most_deg_s = table.limits.theta_rate_rad_s / kDegree;
  const double rate_deg_s = number_field_or(request, "rate_deg_s", 0.01, most_deg_s, most_deg_s);
  cable::ThetaVector goal_rad{};
  for (std::size_t i = 0; i < count; ++i) {
    const double most_deg = limit_deg(table, i);
    if (std::fabs(goal_deg[i]) > most_deg) {
      const auto number = [](double value) { return Json(value).dump(); };
      throw RequestError("out_of_range", "goal_deg, theta " + std::to_string(i + 1) + ": " + number(goal_deg[i]) +
                                             ": allowed -" + number(most_deg) + " to " + number(most_deg) +
                                             " deg: choose another goal");
    }
    goal_rad[i] = goal_deg[i] * kDegree;
  }
  arbiter_.move_joints(now(), goal_rad, rate_deg_s * kDegree);
  return Json::object();
}

Json Service::on_move_cp(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  const Pose goal = pose_field(request, "goal", reach_m_);
  if (request.contains("hold")) on_hold_theta(client, {{"held", request["hold"]}});
  arbiter_.move_line(now(), goal);
  return Json::object();
}

Json Service::on_servo_cp(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  arbiter_.servo_tip(now(), pose_field(request, "goal", reach_m_));
  return Json::object();
}

Json Service::on_hold_theta(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  const cable::RobotTable& table = config_.robot.table;
  std::uint32_t mask = 0;
  cable::ThetaVector held_rad{};
  read_entries(request, "held", cable::kMaxTheta, [&](std::size_t, const Json& entry) {
    only_fields(entry, {"theta", "target_deg"});
    const auto i = static_cast<std::size_t>(integer_field(entry, "theta", 1, table.theta_count())) - 1;
    held_rad[i] = number_field(entry, "target_deg", -limit_deg(table, i), limit_deg(table, i)) * kDegree;
    mask |= 1u << i;
  });
  arbiter_.hold_theta(now(), mask, held_rad);
  return Json::object();
}

Json Service::on_shape(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  cable::NodeTargets nodes{};
  read_entries(request, "nodes", nodes.size(), [&](std::size_t i, const Json& entry) {
    only_fields(entry, {"node", "position_m", "weight", "threshold_m"});
    const auto node = static_cast<std::int32_t>(integer_field(entry, "node", 1, config_.robot.table.segment_count - 1));
    nodes[i] = {node, point_field(entry, "position_m", reach_m_),
                number_field_or(entry, "weight", 0.0, 1000.0, default_node_weight(config_.robot.table, node)),
                number_field_or(entry, "threshold_m", 0.0, reach_m_, kNodeThreshold_m)};
  });
  cable::KeepClearTargets clear{};
  read_entries(request, "keep_clear", clear.size(), [&](std::size_t i, const Json& entry) {
    only_fields(entry, {"centre_m", "distance_m", "weight"});
    clear[i] = {point_field(entry, "centre_m", reach_m_), number_field(entry, "distance_m", 0.0, reach_m_),
                number_field_or(entry, "weight", 0.0, 1000.0, 1.0)};
  });
  arbiter_.shape(now(), nodes, clear, request.contains("search") && flag_field(request, "search"));
  shape_progress_.restart();
  return Json::object();
}

Json Service::on_use_device(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  const cable::RobotTable& table = config_.robot.table;
  DeviceUse use;
  use.kind = device_kind(text_field(request, "device", 16));
  use.mapping.scale = number_field_or(request, "scale", 0.01, 100.0, 1.0);
  use.mapping.rotation_scale = number_field_or(request, "rotation_scale", 0.0, 10.0, 1.0);
  use.node = request.contains("node")
                 ? static_cast<std::int32_t>(integer_field(request, "node", 0, table.segment_count - 1))
                 : 0;
  use.speed_m_s = number_field_or(request, "speed_m_s", 1e-4, table.limits.tip_speed_m_s, table.limits.tip_speed_m_s);
  if (use.kind != DeviceKind::kNone && !server_.has_role(Role::kOperator))
    throw RequestError("no_device", "no operator is connected");
  arbiter_.use_device(use);
  return Json::object();
}

Json Service::on_retract(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  const std::int64_t until = request.contains("until_tick") ? integer_field(request, "until_tick", 0, 1LL << 53) : 0;
  arbiter_.retract(now(), static_cast<std::uint64_t>(until));
  return Json::object();
}

Json Service::on_hold(const ClientInfo& client, const Json&) {
  owner_.require(client.id);
  arbiter_.hold();
  return Json::object();
}

Json Service::on_tool(const ClientInfo& client, const Json& request) {
  owner_.require(client.id);
  note("tool: " + text_field(request, "command", 64));
  return {{"tick", tick()}};
}

// Never refused, and first of all the flag: nothing that may fail stands before it.
Json Service::on_stop(const ClientInfo& client, const Json& request) {
  press_stop();
  arbiter_.hold();
  const StopOrder order{printable(client.name), stop_reason(request.find("reason")), tick()};
  // A mission's own stop is how it ends; everybody else's stays in force, so that nothing enables the arm by itself
  // afterwards.
  if (client.role != Role::kMission) notes_.stop.press(order);
  note(text_of(order));
  return Json::object();
}

// Acted on at the next interval: where the end of the mission stops the arm, and the mission has just ended, its
// (repeatable) time counts.
Json Service::on_shutdown(const ClientInfo& client, const Json&) {
  dismissed_ = true;
  note("shutdown asked for by '" + client.name + "'");
  return Json::object();
}

Json Service::on_announce(const ClientInfo& client, const Json& request) {
  if (client.role != Role::kMission) throw RequestError("bad_request", "announce is for role mission");
  const Json step = request.value("step", Json());
  if (!step.is_null() && !step.is_object())
    throw RequestError("bad_request", "field 'step': must be an object or null");
  notes_.step = nullptr;
  if (step.is_null()) return Json::object();
  notes_.step = {{"index", integer_field(step, "index", 0, 1000)},
                 {"name", text_field(step, "name", 120)},
                 {"device", text_field(step, "device", 16)}};
  note("step " + std::to_string(notes_.step["index"].get<int>()) + ": " + notes_.step["name"].get<std::string>());
  return {{"tick", tick()}};
}

Json Service::on_operator_says(const ClientInfo& client, const Json& request) {
  if (client.role != Role::kOperator) throw RequestError("bad_request", "operator_says is for role operator");
  notes_.operator_says = {{"what", text_field(request, "what", 40)}, {"tick", tick()}};
  return Json::object();
}

Json Service::on_device(const ClientInfo& client, const Json& request) {
  if (client.role != Role::kOperator) throw RequestError("bad_request", "device samples are for role operator");
  add_samples(request, arbiter_.device());
  return Json::object();
}

Json Service::on_camera(const ClientInfo& client, const Json& request) {
  if (client.role != Role::kCamera) throw RequestError("bad_request", "camera frames are for role camera");
  const double capture_s = number_field(request, "capture_time_s", 0.0, 1e9);
  CameraFrame frame{0, request.dump()};
  if (config_.time_mode != TimeMode::kReal) {
    // Sent in the slot after capture plus latency, it is certainly here two slots later; one more for rounding.
    const double ready_s = capture_s + config_.scene.camera.value_or(SceneCamera{}).latency_s;
    frame.due_tick = static_cast<std::uint64_t>(std::ceil(ready_s / config_.robot.table.tick_s - 1e-6)) + 3;
  }
  if (camera_.size() >= 64)
    throw RequestError("busy", "64 camera frames are waiting: their time stamps lie in the future");
  camera_.push_back(frame);
  return Json::object();
}

Json Service::on_timing(const ClientInfo&, const Json& request) {
  const bool reset = request.contains("reset") && flag_field(request, "reset");
  if (config_.time_mode != TimeMode::kReal) {
    throw RequestError("refused", "timing: time mode " + std::string(time_mode_name(config_.time_mode)) +
                                      " has no wake-ups to measure; only --time real has");
  }
  link_.report.refresh();
  const Overruns& overruns = link_.report.value().overruns;
  Json answer =
      timing_message(link_.timing.wakeup_us.counts(), link_.timing.tick_us.counts(), overruns.since(overruns_before_));
  if (!reset) return answer;
  link_.timing.wakeup_us.reset();
  link_.timing.tick_us.reset();
  overruns_before_ = overruns;
  return answer;
}

}  // namespace liana
