#include "host/control/server/serial_arm_server.hpp"

#include <cmath>

#include "firmware_like/serial/drive_units.hpp"
#include "host/control/force_control/requests.hpp"
#include "host/control/server/push_message.hpp"
#include "host/control/server/state_parts.hpp"
#include "host/control/verification/judge_serial.hpp"

namespace liana::server {

namespace {

std::vector<double> deg(const serial::RobotParams& table, const serial::JointVector& rad) {
  std::vector<double> out;
  for (std::size_t i = 0; i < table.joints(); ++i) out.push_back(in_degrees(rad[i]));
  return out;
}

std::string deg_text(double rad) { return Json(std::round(in_degrees(rad) * 1e3) / 1e3).dump(); }

// The first joint that keeps the arm from being homed.
NotHomed why_not(const serial::RobotParams& table, const serial::Inputs& inputs) {
  using enum NotHomedReason;
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const std::string joint = "joint " + std::to_string(i + 1);
    if (inputs.drive[i].feedback_age_ticks == 0xFFFF)
      return {kDriveNotHeard, joint + ": its drive has not been heard yet"};
    const double angle_rad = serial::joint_at_counts(table.drive[i], inputs.drive[i].position_counts);
    if (angle_rad < table.joint[i].low_rad - serial::kRangeMargin_rad ||
        angle_rad > table.joint[i].high_rad + serial::kRangeMargin_rad) {
      return {kOutOfRange, joint + ": its encoder reads " + deg_text(angle_rad) + " deg; allowed " +
                               deg_text(table.joint[i].low_rad) + " to " + deg_text(table.joint[i].high_rad) +
                               ": check zero_counts and direction of the table"};
    }
  }
  return {kNotSettled, "the encoders have not been plausible for 25 ticks: one of them jumps"};
}

// Called in another thread: it has all it needs with it.
arbiter::PathCheck<serial::SerialArm> path_check(const config::SerialRobotConfig& robot,
                                                 const config::SceneConfig& scene, bool carries) {
  return [robot, scene, carries](const std::vector<serial::JointVector>& points_rad, std::optional<double>) {
    simulation::SerialSimulation simulation(simulation::serial_model(robot, scene), scene);
    return verification::refusal_of_way(robot.table, simulation, points_rad, carries);
  };
}

}  // namespace

SerialArmServer::SerialArmServer(const config::SerialRobotConfig& robot, const config::SceneConfig& scene,
                                 timing::TimeMode time_mode, realtime::ArmMailbox<serial::SerialArm>& link)
    : TypedArmServer(robot.table, arbiter::SpeedZone{}, time_mode, link,
                     std::make_unique<verification::SimulationVerifier<serial::SerialArm>>(
                         simulation::serial_model(robot, scene), scene),
                     taken(time_mode), path_check(robot, scene, false)),
      robot_(robot) {
  handlers_["insert"] = [this](const MotionRequest& r) {
    arbiter_.push(outputs(), force_control::push_of(robot_, r.fields));
  };
  handlers_["payload"] = [this, scene](const MotionRequest& r) {
    const serial::LinkMass payload = force_control::payload_of(r.fields);
    arbiter_.carry(payload, path_check(robot_, scene, payload.mass_kg > 0.0));
  };
  handlers_["comply"] = [this](const MotionRequest&) {
    force_control::require_torque_drives(robot_);
    arbiter_.follow(outputs());
  };
  handlers_["adapter"] = [this](const MotionRequest& r) { tell_adapter(r.fields); };
}

// A sequence of its own for every request, never 0, which is none.
void SerialArmServer::tell_adapter(const api::Arguments& fields) {
  force_control::require_adapter(robot_);
  if (outputs().push.adapter_age_ticks >= serial::kAdapterSilentTicks)
    throw api::RequestError("refused", "the adapter is not heard: look at its supply and at the bus that it is on");
  if (++adapter_sequence_ == 0) adapter_sequence_ = 1;
  const bool locks = fields.text("command") == "lock";
  link_.adapter.store({locks ? serial::AdapterCommand::kLock : serial::AdapterCommand::kRelease, adapter_sequence_},
                      std::memory_order_release);
}

void SerialArmServer::watch(bool booted) {
  if (booted) not_homed_ = outputs().homed != 0 ? NotHomed{NotHomedReason::kHomed, ""} : why_not(table_, inputs());
}

std::vector<double> SerialArmServer::joints_deg(const serial::Outputs& outputs) const {
  return deg(table_, outputs.joint_command_rad);
}

void SerialArmServer::add_state(Json& state) const {
  const serial::Outputs& o = outputs();
  const serial::ArmKinematics arm = serial::forward_kinematics(table_, o.joint_command_rad);
  Json points = Json::array(), torque_Nm = Json::array();
  for (std::size_t i = 1; i <= table_.joints(); ++i) points.push_back(arm.point_in_base[i]);
  for (std::size_t i = 0; i < table_.joints(); ++i) torque_Nm.push_back(o.torque_measured_Nm[i]);
  state["is_busy"] = arbiter_.is_busy() || (o.state == OperatingState::kEnabled && o.at_rest == 0);
  add_retract(state, arbiter_.retract_state());
  state["path"] = path_json(arbiter_.path());
  state["servo"] = servo_json(arbiter_.servo_report());
  state["measured_js_deg"] = deg(table_, o.joint_measured_rad);
  state["setpoint_js_deg"] = deg(table_, o.joint_command_rad);
  state["measured_cp"] = pose_json(serial::forward_kinematics(table_, o.joint_measured_rad).tip_in_base);
  state["node_m"] = points;
  state["held"] = Json::array();
  state["held_at_target"] = true;
  state["torque_Nm"] = torque_Nm;
  state["device"] = "none";
  Json told_Nm = Json::array();
  for (std::size_t i = 0; i < table_.joints(); ++i) told_Nm.push_back(o.torque_told_Nm[i]);
  state["torque_commanded_Nm"] = told_Nm;
  state["payload"] = payload_json(arbiter_.carried().mass_kg, arbiter_.carried().center_m);
  state["insert"] = push_json(o.push, table_.tick_s);
  state["adapter"] = adapter_json(o.push, table_.tick_s);
  add_tip(state, o);
}

void SerialArmServer::add_drive_state(std::size_t drive, Json& state) const {
  state["position_deg"] =
      in_degrees(serial::joint_at_counts(table_.drive[drive], inputs().drive[drive].position_counts));
  state["torque_Nm"] = outputs().torque_measured_Nm[drive];
}

}  // namespace liana::server
