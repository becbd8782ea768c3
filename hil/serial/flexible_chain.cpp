#include "hil/serial/flexible_chain.hpp"

#include <algorithm>
#include <stdexcept>

#include "hil/serial/flexible_engine.hpp"
#include "hil/serial/link_axis.hpp"
#include "hil/serial/serial_mjcf.hpp"

namespace liana::bench {

FlexibleChain::FlexibleChain(const SerialRobotConfig& robot, const std::vector<double>& joint_rad,
                             const BodyConfig& payload)
    : robot_(robot), engine_(std::make_unique<Engine>(make_mjcf_with_base(robot, payload))) {
  if (robot_.stiffness_Nm_rad.size() != robot_.joints.size())
    throw std::runtime_error(
        "physics: the joints of the robot say no stiffness_Nm_per_rad; an arm that gives torque needs it at every "
        "joint of its table");
  if (robot_.base) {
    base_told_rad_ = robot_.base->joint_rad;
    base_joints_ = base_told_rad_.size();
    for (std::size_t i = 0; i < base_joints_; ++i) {
      offset_rad_[i] = robot_.base->robot.joints[i].offset_rad;
      angle_[i] = base_told_rad_[i];
    }
  }
  hinges_ = base_joints_ + robot_.joints.size();
  for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
    offset_rad_[base_joints_ + i] = robot_.joints[i].offset_rad;
    angle_[base_joints_ + i] = joint_rad.at(i);
    rotors_.push_back({joint_rad[i], 0.0});
    friction_.emplace_back(robot_.coulomb_Nm, joint_rad[i]);
  }
  place(angle_, rate_);
}

FlexibleChain::~FlexibleChain() = default;

void FlexibleChain::place(const Theta& angle_rad, const Theta& rate_rad_s) const {
  for (std::size_t i = 0; i < hinges_; ++i) {
    engine_->data->qpos[i] = angle_rad[i] + offset_rad_[i];
    engine_->data->qvel[i] = rate_rad_s[i];
  }
  mj_kinematics(engine_->model, engine_->data);
  mj_comPos(engine_->model, engine_->data);
  mj_comVel(engine_->model, engine_->data);
}

double FlexibleChain::joint_rad(std::size_t i) const { return angle_[base_joints_ + i]; }

double FlexibleChain::gear_Nm(std::size_t i) const {
  return robot_.stiffness_Nm_rad[i] * wound_rad(i) +
         robot_.gear_damping_Nms_per_rad * (rotors_[i].rate_rad_s - joint_rate_rad_s(i));
}

TipState FlexibleChain::state_of(int body) const {
  const mjtNum* p = engine_->data->xpos + 3 * body;
  const mjtNum* q = engine_->data->xquat + 4 * body;
  mjtNum v[6];
  mj_objectVelocity(engine_->model, engine_->data, mjOBJ_BODY, body, v, 0);
  const Vec3 rate{v[0], v[1], v[2]}, of_center{v[3], v[4], v[5]};
  const mjtNum* c = engine_->data->xipos + 3 * body;  // where MuJoCo takes the velocity of a body
  const Vec3 at{p[0], p[1], p[2]};
  return {{at, {q[0], q[1], q[2], q[3]}}, of_center + cross(rate, at - Vec3{c[0], c[1], c[2]}), rate};
}

TipState FlexibleChain::tip() const { return state_of(engine_->tip); }

std::vector<Vec3> FlexibleChain::axis_m() const { return link_axis_m(*engine_, robot_); }

TipState FlexibleChain::base() const { return engine_->base < 0 ? TipState{} : state_of(engine_->base); }

Pose FlexibleChain::base_when_at(const std::vector<double>& joint_rad) const {
  Theta there = angle_;
  std::copy(joint_rad.begin(), joint_rad.end(), there.begin());
  place(there, rate_);
  const Pose pose = base().pose;
  place(angle_, rate_);
  return pose;
}

void FlexibleChain::carry(const BodyConfig& payload) {
  engine_ = std::make_unique<Engine>(make_mjcf_with_base(robot_, payload));
  place(angle_, rate_);
  if (engine_->payload >= 0) payload_ = payload_momentum();
}

FlexibleChain::Momentum FlexibleChain::payload_momentum() const {
  const mjData* const data = engine_->data;
  const int body = engine_->payload;
  const mjtNum* c = data->xipos + 3 * body;
  const TipState frame = state_of(body);
  const Vec3 arm = Vec3{c[0], c[1], c[2]} - frame.pose.position_m;
  mjtNum within[3];  // rates about the principal axes
  const mjtNum w[3] = {frame.rate_rad_s.x, frame.rate_rad_s.y, frame.rate_rad_s.z};
  mju_rotVecMatT(within, w, data->ximat + 9 * body);
  for (int k = 0; k < 3; ++k) within[k] *= engine_->model->body_inertia[3 * body + k];
  mjtNum spin[3];
  mju_rotVecMat(spin, within, data->ximat + 9 * body);
  return {frame.velocity_m_s + cross(frame.rate_rad_s, arm), {spin[0], spin[1], spin[2]}, arm};
}

// Without a payload the sensor feels what pushes; with one, what is left of it after the payload is moved.
void FlexibleChain::feel_wrist(double step_s) {
  const Quat into_tip = conjugate(tip().pose.attitude);
  wrist_ = {rotate(into_tip, pushed_.force_N), rotate(into_tip, pushed_.torque_Nm)};
  if (engine_->payload < 0) return;
  const Momentum now = payload_momentum();
  const Vec3 force =
      (engine_->model->body_mass[engine_->payload] / step_s) * (now.velocity_m_s - payload_.velocity_m_s);
  const Vec3 torque = (1.0 / step_s) * (now.spin - payload_.spin) + cross(now.arm_m, force);
  payload_ = now;
  wrist_.force_N = wrist_.force_N - rotate(into_tip, force);
  wrist_.torque_Nm = wrist_.torque_Nm - rotate(into_tip, torque);
}

double FlexibleChain::energy_J() const {
  mj_crb(engine_->model, engine_->data);
  mjtNum momentum[kMaxTheta];
  mj_mulM(engine_->model, engine_->data, momentum, engine_->data->qvel);
  double energy = 0.0;
  for (std::size_t i = 0; i < hinges_; ++i) energy += 0.5 * momentum[i] * rate_[i];
  for (std::size_t i = 0; i < base_joints_; ++i) {
    const double wound = base_told_rad_[i] - angle_[i];
    energy += 0.5 * robot_.base->robot.stiffness_Nm_rad[i] * wound * wound;
  }
  for (std::size_t i = 0; i < rotors_.size(); ++i) {
    energy += 0.5 * robot_.rotor_inertia_kgm2 * rotors_[i].rate_rad_s * rotors_[i].rate_rad_s;
    energy += 0.5 * robot_.stiffness_Nm_rad[i] * wound_rad(i) * wound_rad(i);
    energy += friction_[i].energy_J(joint_rad(i));
  }
  return energy;
}

}  // namespace liana::bench
