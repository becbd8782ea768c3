// One step of a FlexibleChain: midpoint rule, implicit in springs, damping and friction that sticks.
#include <stdexcept>

#include "hil/serial/flexible_engine.hpp"

namespace liana::bench {

// Inertia and contact in the middle of the step, foreseen from the last one: M dv = h (contact - h(q, v)).
FlexibleChain::Equations FlexibleChain::free_motion(double step_s, const Contact& contact) {
  Theta angle = angle_, rate = rate_;
  for (std::size_t i = 0; i < hinges_; ++i) {
    angle[i] += 0.5 * step_s * rate_[i];
    rate[i] += 0.5 * step_s * accel_[i];
  }
  place(angle, rate);
  mjModel* const model = engine_->model;
  mjData* const data = engine_->data;
  const TipState at = tip();
  pushed_ = contact(at);
  const Vec3 &force = pushed_.force_N, &torque = pushed_.torque_Nm, &point = at.pose.position_m;
  const mjtNum f[3] = {force.x, force.y, force.z}, t[3] = {torque.x, torque.y, torque.z},
               p[3] = {point.x, point.y, point.z};
  mjtNum push[kMaxTheta] = {}, bias[kMaxTheta], full[kMaxTheta * kMaxTheta];
  mj_applyFT(model, data, f, t, p, engine_->tip, push);
  mj_crb(model, data);
  mj_rne(model, data, 0, bias);
  mj_fullM(model, full, data->qM);
  Equations equations;
  for (std::size_t r = 0; r < hinges_; ++r) {
    for (std::size_t c = 0; c < hinges_; ++c) equations.matrix[r][c] = full[r * hinges_ + c];
    equations.right[r] = step_s * (push[r] - bias[r]);
  }
  return equations;
}

// A spring from a hinge to what stands still; `wound_rad` is what it wants the hinge to turn at the step's beginning.
void FlexibleChain::add_spring(std::size_t hinge, double stiffness, double damping, double wound_rad, double step_s,
                               Equations& equations) const {
  const double rate = rate_[hinge];
  equations.matrix[hinge][hinge] += 0.25 * step_s * step_s * stiffness + 0.5 * step_s * damping;
  equations.right[hinge] += step_s * (stiffness * (wound_rad - 0.5 * step_s * rate) - damping * rate);
}

// What the gear gives in this step as if both its ends went on at their rates, and what of it changes per change of one
// end's rate.
FlexibleChain::Gear FlexibleChain::gear(std::size_t i, double step_s) const {
  const double stiffness = robot_.stiffness_Nm_rad[i], damping = robot_.gear_damping_Nms_per_rad;
  const double apart = rotors_[i].rate_rad_s - joint_rate_rad_s(i);
  return {step_s * (stiffness * (wound_rad(i) + 0.5 * step_s * apart) + damping * apart),
          0.25 * step_s * step_s * stiffness + 0.5 * step_s * damping};
}

// The rotor is a mass on the spring's other end, and is eliminated.
void FlexibleChain::add_gear(std::size_t i, const RotorDrive& drive, double step_s, Equations& equations) const {
  const std::size_t hinge = base_joints_ + i;
  const auto [given, coupling] = gear(i, step_s);
  if (!drive.is_torque_controlled) {
    equations.matrix[hinge][hinge] += coupling;
    equations.right[hinge] += given + coupling * (drive.rate_rad_s - rotors_[i].rate_rad_s);
    return;
  }
  const double share = coupling / (robot_.rotor_inertia_kgm2 + coupling);
  equations.matrix[hinge][hinge] += robot_.rotor_inertia_kgm2 * share;
  equations.right[hinge] += given + share * (step_s * drive.torque_Nm - given);
}

void FlexibleChain::add_friction(std::size_t i, double step_s, Equations& equations) const {
  const std::size_t hinge = base_joints_ + i;
  add_spring(hinge, 0.0, robot_.viscous_Nms_per_rad, 0.0, step_s, equations);
  const double middle = angle_[hinge] + 0.5 * step_s * rate_[hinge];
  equations.right[hinge] += step_s * friction_[i].torque_Nm(middle);
  if (friction_[i].sticks_at(middle))
    equations.matrix[hinge][hinge] += 0.25 * step_s * step_s * friction_[i].stiffness();
}

void FlexibleChain::turn_rotor(std::size_t i, const RotorDrive& drive, double step_s, double hinge_change_rad_s) {
  Rotor& rotor = rotors_[i];
  const double before = rotor.rate_rad_s;
  const auto [given, coupling] = gear(i, step_s);
  rotor.rate_rad_s = drive.rate_rad_s;
  if (drive.is_torque_controlled)
    rotor.rate_rad_s = before + (step_s * drive.torque_Nm - given + coupling * hinge_change_rad_s) /
                                    (robot_.rotor_inertia_kgm2 + coupling);
  rotor.angle_rad += 0.5 * step_s * (before + rotor.rate_rad_s);
}

void FlexibleChain::step(double step_s, const std::vector<RotorDrive>& drives, const Contact& contact) {
  Equations equations = free_motion(step_s, contact);
  if (robot_.base) {
    for (std::size_t i = 0; i < base_joints_; ++i) {
      const double stiffness = robot_.base->robot.stiffness_Nm_rad[i];
      add_spring(i, stiffness, robot_.base->damping_s * stiffness, base_told_rad_[i] - angle_[i], step_s, equations);
    }
  }
  for (std::size_t i = 0; i < rotors_.size(); ++i) {
    add_gear(i, drives[i], step_s, equations);
    add_friction(i, step_s, equations);
  }
  Theta change{};
  if (!solve_spd(equations.matrix, equations.right, hinges_, change))
    throw std::runtime_error("physics: the arm's mass matrix is not positive; are there links without inertia?");
  for (std::size_t i = 0; i < rotors_.size(); ++i) turn_rotor(i, drives[i], step_s, change[base_joints_ + i]);
  for (std::size_t i = 0; i < hinges_; ++i) {
    angle_[i] += step_s * (rate_[i] + 0.5 * change[i]);
    rate_[i] += change[i];
    accel_[i] = change[i] / step_s;
  }
  for (std::size_t i = 0; i < rotors_.size(); ++i) friction_[i].drag(joint_rad(i));
  place(angle_, rate_);
  feel_wrist(step_s);
}

}  // namespace liana::bench
