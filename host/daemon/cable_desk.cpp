#include "host/daemon/cable_desk.hpp"

#include "firmware_like/math/trig.hpp"
#include "host/config/slit_mouth.hpp"
#include "host/daemon/device_messages.hpp"

namespace liana {

namespace {

double reach_of(const cable::RobotTable& table) {
  double reach_m = 0.0;
  for (std::size_t m = 0; m < static_cast<std::size_t>(table.segment_count); ++m) {
    reach_m += table.segment[m].modules * table.segment[m].module_length_m;
  }
  return reach_m;
}

// Limit of a theta, free of what the way through radians left of it.
double limit_deg(const cable::RobotTable& table, std::size_t theta) {
  return std::round(table.segment[theta / 2].theta_limit_rad / kDegree * 1e9) / 1e9;
}

SearchResult taken(TimeMode time_mode) {
  return time_mode == TimeMode::kReal ? SearchResult::kWhenThere : SearchResult::kInItsInterval;
}

SpeedZone zone_of(const RobotConfig& robot, const SceneConfig& scene) {
  return {scene.slit, robot.table.limits.tip_speed_slit_m_s};
}

}  // namespace

CableDesk::CableDesk(const RobotConfig& robot, const SceneConfig& scene, const std::string& in_pose, TimeMode time_mode,
                     ArmLink<cable::CableArm>& link)
    : ArmDesk(robot.table, zone_of(robot, scene), time_mode, link, taken(time_mode)),
      robot_(robot),
      scene_(scene),
      reach_m_(reach_of(robot.table)),
      homing_(robot_, in_pose),
      shape_progress_(robot.table) {
  handlers_ = {{"move_jp", [this](const MotionRequest& r) { on_move_jp(r); }},
               {"move_cp", [this](const MotionRequest& r) { on_move_cp(r); }},
               {"servo_cp", [this](const MotionRequest& r) { on_servo_cp(r); }},
               {"hold_theta", [this](const MotionRequest& r) { on_hold_theta(r.body); }},
               {"shape", [this](const MotionRequest& r) { on_shape(r); }},
               {"use_device", [this](const MotionRequest& r) { on_use_device(r); }},
               {"retract", [this](const MotionRequest& r) { on_retract(r); }},
               {"hold", [this](const MotionRequest&) { hold(); }}};
}

// The slit is looked at by the commanded angles: they have no noise.
void CableDesk::watch(bool booted) {
  shape_progress_.note(outputs(), arbiter_.nodes(), arbiter_.keep_clear());
  if (booted) homing_.look(report(), link_.image.value().controller.arm().estimator());
  if (!scene_.slit) return;
  const cable::LinkPoints links = link_points(table_, outputs().theta_command_rad);
  const solve::SlitMouth mouth = slit_mouth(*scene_.slit, robot_.module_radius_m);
  planar_segments_ = solve::planar_segments(table_, links, mouth, solve::PlanarSwitch{}, planar_segments_);
}

void CableDesk::take_samples(const Json& message) { add_samples(message, arbiter_.device()); }

void CableDesk::drop_motion() {
  arbiter_.hold();
  arbiter_.use_device(DeviceUse{});
}

std::vector<double> CableDesk::joints_deg(const cable::Outputs& outputs) const {
  return theta_deg(table_, outputs.theta_command_rad);
}

void CableDesk::on_move_jp(const MotionRequest& request) {
  const auto count = static_cast<std::size_t>(table_.theta_count());
  const std::vector<double> goal_deg = numbers_field(request.body, "goal_deg", count, -180.0, 180.0);
  const double most_deg_s = table_.limits.theta_rate_rad_s / kDegree;
  const double rate_deg_s = number_field_or(request.body, "rate_deg_s", 0.01, most_deg_s, most_deg_s);
  cable::ThetaVector goal_rad{};
  for (std::size_t i = 0; i < count; ++i) {
    const double most_deg = limit_deg(table_, i);
    if (std::fabs(goal_deg[i]) > most_deg) {
      const auto number = [](double value) { return Json(value).dump(); };
      throw RequestError("out_of_range", "goal_deg, theta " + std::to_string(i + 1) + ": " + number(goal_deg[i]) +
                                             ": allowed -" + number(most_deg) + " to " + number(most_deg) +
                                             " deg: choose another goal");
    }
    goal_rad[i] = goal_deg[i] * kDegree;
  }
  arbiter_.move_joints(outputs(), goal_rad, rate_deg_s * kDegree);
}

void CableDesk::on_move_cp(const MotionRequest& request) {
  const Pose goal = pose_field(request.body, "goal", reach_m_);
  if (request.body.contains("hold")) on_hold_theta({{"held", request.body["hold"]}});
  arbiter_.move_line(outputs(), goal);
}

void CableDesk::on_servo_cp(const MotionRequest& request) {
  arbiter_.servo_tip(outputs(), pose_field(request.body, "goal", reach_m_));
}

void CableDesk::on_hold_theta(const Json& request) {
  std::uint32_t mask = 0;
  cable::ThetaVector held_rad{};
  read_entries(request, "held", cable::kMaxTheta, [&](std::size_t, const Json& entry) {
    only_fields(entry, {"theta", "target_deg"});
    const auto i = static_cast<std::size_t>(integer_field(entry, "theta", 1, table_.theta_count())) - 1;
    held_rad[i] = number_field(entry, "target_deg", -limit_deg(table_, i), limit_deg(table_, i)) * kDegree;
    mask |= 1u << i;
  });
  arbiter_.hold_theta(outputs(), mask, held_rad);
}

void CableDesk::on_shape(const MotionRequest& request) {
  cable::NodeTargets nodes{};
  read_entries(request.body, "nodes", nodes.size(), [&](std::size_t i, const Json& entry) {
    only_fields(entry, {"node", "position_m", "weight", "threshold_m"});
    const auto node = static_cast<std::int32_t>(integer_field(entry, "node", 1, table_.segment_count - 1));
    nodes[i] = {node, point_field(entry, "position_m", reach_m_),
                number_field_or(entry, "weight", 0.0, 1000.0, default_node_weight(table_, node)),
                number_field_or(entry, "threshold_m", 0.0, reach_m_, kNodeThreshold_m)};
  });
  cable::KeepClearTargets clear{};
  read_entries(request.body, "keep_clear", clear.size(), [&](std::size_t i, const Json& entry) {
    only_fields(entry, {"centre_m", "distance_m", "weight"});
    clear[i] = {point_field(entry, "centre_m", reach_m_), number_field(entry, "distance_m", 0.0, reach_m_),
                number_field_or(entry, "weight", 0.0, 1000.0, 1.0)};
  });
  arbiter_.shape(outputs(), nodes, clear, request.body.contains("search") && flag_field(request.body, "search"));
  shape_progress_.restart();
}

void CableDesk::on_use_device(const MotionRequest& request) {
  DeviceUse use;
  use.kind = device_kind(text_field(request.body, "device", 16));
  use.mapping.scale = number_field_or(request.body, "scale", 0.01, 100.0, 1.0);
  use.mapping.rotation_scale = number_field_or(request.body, "rotation_scale", 0.0, 10.0, 1.0);
  use.node = request.body.contains("node")
                 ? static_cast<std::int32_t>(integer_field(request.body, "node", 0, table_.segment_count - 1))
                 : 0;
  use.speed_m_s =
      number_field_or(request.body, "speed_m_s", 1e-4, table_.limits.tip_speed_m_s, table_.limits.tip_speed_m_s);
  if (use.kind != DeviceKind::kNone && !request.operator_is_here)
    throw RequestError("no_device", "no operator is connected");
  arbiter_.use_device(use);
}

void CableDesk::on_retract(const MotionRequest& request) {
  const std::int64_t until =
      request.body.contains("until_tick") ? integer_field(request.body, "until_tick", 0, 1LL << 53) : 0;
  arbiter_.retract(outputs(), static_cast<std::uint64_t>(until));
}

}  // namespace liana
