#include "host/apps/web/core/try_arm.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/base/json/json.hpp"
#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/verification/refusal_table.hpp"
#include "host/control/verification/verify.hpp"
#include "host/model/clearance/arm_clearance.hpp"
#include "host/model/config/sha256.hpp"
#include "host/model/config/slit_mouth.hpp"
#include "host/storage/recording/image.hpp"
#include "host/storage/recording/serialise.hpp"

namespace liana::web {

namespace {

constexpr std::uint32_t kOwner = 1;
constexpr double kLead_s = 0.5;                 // of the tip's speed: as far ahead of the tip as lianad takes a goal
constexpr double kFreeShare = 0.6;              // of the tip's limit: a mouse is no smooth hand, and bodies swing
constexpr double kKeepClear_m = 0.10;           // of the arm's surface from the scene's spheres
constexpr double kPlanarBefore_m = 0.45;        // before the mouth, segment 5 comes into the slit's plane
constexpr double kNearSlit_m = 0.30;            // off the slit's plane: farther away nothing is made planar
constexpr std::uint16_t kSwitchedOff = 0x0250;  // statusword of CiA 402: switch on disabled, voltage on

// Drives that are switched off, of an arm that stands there with its cables pulled as planned.
cable::Inputs standing(const cable::RobotParams& table, const cable::ThetaVector& theta_rad) {
  cable::Inputs inputs;
  const cable::CableLayout layout = cable::cable_layout(table);
  const cable::ArmTrig trig = cable::arm_trig(table, theta_rad);
  const cable::TensionRatio ratio = cable::tension_ratio(table, layout, trig, cable::SlipState{});
  const cable::CableVector motor_N = cable::plan_at_rest(table, layout, theta_rad).motor_N;
  const cable::CableVector payout_m =
      cable::payout_for(table, layout, cable::cable_geometry(table, layout, trig).part_m, ratio, motor_N);
  for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
    DriveFeedback& drive = inputs.drive[c];
    const double zero_m = layout.zero_length_m[c] + table.lead_m;
    drive.position_counts = to_counts(cable::counts_at_payout(table.drive[c], zero_m, payout_m[c])).value;
    drive.torque_permille = narrow<std::int16_t>(to_counts(motor_N[c] / table.drive[c].newtons_per_permille).value);
    drive.statusword = kSwitchedOff;
    drive.feedback_age_ticks = drive.heartbeat_age_ticks = 0;
    drive.operational = 1;
  }
  return inputs;
}

cable::KeepClearTargets keep_clear_of(const config::RobotConfig& robot, const config::SceneConfig& scene) {
  cable::KeepClearTargets out{};
  for (std::size_t i = 0; i < std::min(out.size(), scene.spheres.size()); ++i) {
    const config::SceneSphere& sphere = scene.spheres[i];
    out[i] = {sphere.center_m, sphere.radius_m + robot.module_radius_m + kKeepClear_m, 1.0};
  }
  return out;
}

Vec3 no_longer(const Vec3& way, double most) {
  const double length = norm(way);
  return length > most ? scale(way, most / length) : way;
}

// From `tip` towards `target`, no farther than lead_m and lead_rad.
Pose ahead(const Pose& tip, const Pose& target, double lead_m, double lead_rad) {
  const Vec3 way_m = no_longer(subtract(target.position_m, tip.position_m), lead_m);
  const Vec3 turn_rad = rotation_vector(multiply(target.quaternion, conjugate(tip.quaternion)));
  return {add(tip.position_m, way_m),
          normalize(multiply(quaternion_of(no_longer(turn_rad, lead_rad)), tip.quaternion))};
}

template <class Vector>
Json first_of(const Vector& values, std::int32_t count, double unit = 1.0) {
  Json out = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) out.push_back(values[i] / unit);
  return out;
}

Json pose_json(const Pose& pose) {
  const Vec3& p = pose.position_m;
  const Quat& q = pose.quaternion;
  return Json::array({p[0], p[1], p[2], q[0], q[1], q[2], q[3]});
}

// Numbers of the angles that are held, from 1.
Json held_json(std::uint32_t mask, const cable::RobotParams& table) {
  Json out = Json::array();
  for (std::int32_t i = 0; i < table.theta_count(); ++i) {
    if ((mask >> i & 1u) != 0) out.push_back(i + 1);
  }
  return out;
}

// Where the arm would stand if nothing more were asked of it; empty before a first command.
Json stop_json(const verification::Prediction<cable::CableArm>& prediction, const cable::RobotParams& table) {
  if (prediction.ticks.empty()) return Json::array();
  return first_of(prediction.ticks.back().theta_command_rad, table.theta_count(), kDegree);
}

Json faults_json(const FaultList& faults) {
  Json out = Json::array();
  for (std::int32_t i = 0; i < faults.count; ++i) {
    const Fault& fault = faults.fault[static_cast<std::size_t>(i)];
    out.push_back({{"number", static_cast<int>(fault.number)},
                   {"name", fault_info(fault.number).name},
                   {"index", static_cast<int>(fault.index)}});
  }
  return out;
}

}  // namespace

TryArm::TryArm(const config::RobotConfig& robot, const config::SceneConfig& scene, const cable::ThetaVector& start_rad)
    : robot_(robot),
      scene_(scene),
      rules_{robot.table,
             scene,
             {scene.slit, robot.table.limits.tip_speed_slit_m_s},
             robot.machine,
             robot.module_radius_m},
      keep_clear_(keep_clear_of(robot, scene)),
      interval_ticks_(static_cast<std::uint64_t>(robot.table.interval_ticks)),
      interval_s_(static_cast<double>(robot.table.interval_ticks) * robot.table.tick_s),
      image_(robot_.table),
      drives_(robot_.table, standing(robot.table, start_rad)),
      simulation_(simulation::arm_model(robot), scene, verification::kEnough_m),
      observer_(simulation::arm_model(robot)),
      guidance_(robot.table, scene.fixtures, robot.module_radius_m),
      ramp_(arbiter::ArmTraits<Arm>::goal_ramp(robot.table)) {
  if (scene.slit) mouth_ = config::slit_mouth(*scene.slit, robot.module_radius_m);
  image_.last_inputs = standing(robot.table, start_rad);
  image_.next_tick = 1;
}

void TryArm::interval(Request request, const std::optional<Pose>& target) {
  observe();
  const cable::Outputs& now = image_.last_outputs;
  std::optional<cable::Telecommand> command;
  if (target && now.state == OperatingState::kEnabled) {
    if (!wait_.holds(now.tip_command, *target, interval_s_)) {
      command = verified(setpoint_towards(*target));
      if (!command) wait_.refuse(now.tip_command, *target);
    }
  } else {
    guidance_.stop();
    wait_.forget();
    code_ = verification::Refusal::kNone;
    text_.clear();
  }
  for (std::uint64_t i = 0; i < interval_ticks_; ++i)
    tick(i == 0 ? request : Request::kNone, i == 0 ? command : std::nullopt);
}

// How the arm swings, and how near to the scene it has come, go on from interval to interval as in lianad.
void TryArm::observe() {
  const cable::Outputs& now = image_.last_outputs;
  if (now.state != OperatingState::kEnabled) too_near_.disabled();
  if (now.homed == 0) {
    too_near_.forget();
    observer_.forget();
  }
  ramp_.note(now.tip_speed_m_s, interval_s_);
  observer_.watch(now.theta_measured_rad, now.tension_measured_N, verification::told_now(robot_.table, now),
                  interval_s_);
}

double TryArm::speed_m_s() const {
  const double free_m_s = std::min(ramp_.speed_m_s(), kFreeShare * robot_.table.limits.tip_speed_m_s);
  return wait_.speed_share() * rules_.zone.advice_at(image_.last_outputs.tip_command.position_m, free_m_s);
}

std::int32_t TryArm::planar_segments(const Pose& tip) const {
  if (!scene_.slit) return 0;
  const cable::LinkPoints links = cable::link_points(robot_.table, image_.last_outputs.theta_command_rad);
  const std::int32_t inside = inverse_kinematics::planar_segments(robot_.table, links, mouth_, {}, planar_);
  const Vec3 at = virtual_fixtures::in_frame(mouth_.frame_in_base, tip.position_m);
  const bool is_before = at[0] > -kPlanarBefore_m && std::fabs(at[1]) < kNearSlit_m;
  return std::max(inside, is_before ? 1 : 0);
}

cable::Setpoint TryArm::setpoint_towards(const Pose& target) {
  const cable::Outputs& now = image_.last_outputs;
  planar_ = planar_segments(now.tip_command);
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  setpoint.held_mask = inverse_kinematics::planar_pitches(robot_.table, planar_);
  setpoint.clear = keep_clear_;
  setpoint.tip_speed_m_s = speed_m_s();
  const double turn_rad_s = robot_.table.limits.tip_rate_rad_s * wait_.speed_share();
  const Pose goal = ahead(now.tip_command, target, kLead_s * setpoint.tip_speed_m_s, kLead_s * turn_rad_s);
  // While a pitch goes to its held value the tip stays where it is.
  const bool is_held = now.held_mask == setpoint.held_mask && now.held_at_target != 0;
  const virtual_fixtures::Commanded commanded{now.tip_command, now.theta_command_rad, now.held_mask};
  guidance_.see({}, interval_s_);
  setpoint.tip_in_base = is_held ? guidance_.guide(goal, commanded, interval_s_) : now.tip_command;
  return setpoint;
}

// The telecommand, when both ends pass it: in force from the next tick, for one interval.
std::optional<cable::Telecommand> TryArm::verified(const cable::Setpoint& setpoint) {
  const auto candidate = issue_.candidate(setpoint, kOwner, image_.next_tick, interval_ticks_);
  verification::Twin<Arm>::run(image_, {}, candidate, verification::max_stop_ticks(robot_.table.tick_s), prediction_);
  const verification::ExecutionVerdict execution =
      verification::judge_execution<Arm>(robot_.table, candidate, prediction_, rules_.zone);
  verification::read_sequence(image_, candidate.first_tick(), prediction_, sequence_);
  verification::SimulationVerdict simulated = verification::judge_simulated(
      rules_, sequence_, prediction_.comes_to_rest, simulation_.run(observer_.now(), sequence_), too_near_);
  simulated.sequence = candidate.sequence();
  simulated.trial = candidate.trial();
  const verification::Verdict& first =
      execution.passed() ? static_cast<const verification::Verdict&>(simulated) : execution;
  code_ = first.code;
  text_ = first.text;
  claim_m_ = simulated.margins.clearance_m;
  auto command = issue_.release(candidate, execution, simulated);
  ++(command ? released_ : refused_);
  return command;
}

void TryArm::tick(Request request, const std::optional<cable::Telecommand>& command) {
  cable::Inputs inputs = image_.fresh ? image_.last_inputs : drives_.next_inputs(image_.next_tick, image_.last_outputs);
  inputs.tick = image_.next_tick++;
  inputs.request = request;
  if (command) inputs.telecommand = *command;
  image_.last_outputs = image_.controller.tick(inputs);
  image_.last_inputs = inputs;
  image_.fresh = false;
}

std::string TryArm::state() const {
  const cable::Outputs& now = image_.last_outputs;
  const cable::RobotParams& table = robot_.table;
  const auto points = cable::link_points(table, now.theta_measured_rad);
  const clearance::ArmClearance near = clearance::arm_clearance(points.axis(), robot_.module_radius_m, scene_);
  const Vec3& where_m = near.nearest.on_obstacle_m;
  return Json({{"tick", now.tick},
               {"time_s", static_cast<double>(now.tick) * table.tick_s},
               {"state", kOperatingStateNames[static_cast<std::size_t>(now.state)]},
               {"is_homed", now.homed != 0},
               {"at_rest", now.at_rest != 0},
               {"faults", faults_json(now.faults)},
               {"planar_segments", inverse_kinematics::planar_pitches(table, planar_) == now.held_mask ? planar_ : 0},
               {"held_at_target", now.held_at_target != 0},
               {"held", held_json(now.held_mask, table)},
               {"measured_cp", pose_json(cable::forward_kinematics(table, now.theta_measured_rad).tip_in_base)},
               {"measured_js_deg", first_of(now.theta_measured_rad, table.theta_count(), kDegree)},
               {"setpoint_js_deg", first_of(now.theta_command_rad, table.theta_count(), kDegree)},
               {"setpoint_cp", pose_json(now.tip_command)},
               {"tension_N", first_of(now.tension_measured_N, table.cable_count())},
               {"tip_speed_m_s", now.tip_speed_m_s},
               {"clearance",
                {{"distance_m", near.distance_m()},
                 {"link", near.link + 1},
                 {"body", near.obstacle < 0 ? "" : clearance::obstacle_name(scene_, near.obstacle)},
                 {"where_m", Json::array({where_m[0], where_m[1], where_m[2]})}}},
               {"verdict",
                {{"code", static_cast<int>(code_)},
                 {"text", text_},
                 {"stop_js_deg", stop_json(prediction_, table)},
                 {"clearance_left_m", claim_m_}}},
               {"commands", {{"released", released_}, {"refused", refused_}}}})
      .dump();
}

std::string TryArm::hash() const {
  std::string bytes;
  recording::append_state(bytes, image_.controller);
  recording::append_serialised(bytes, image_.last_outputs);
  bytes += std::to_string(refused_);
  return config::sha256_hex(bytes);
}

}  // namespace liana::web
