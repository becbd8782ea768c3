#include "hil/arm/arm_physics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hil/arm/stable_step.hpp"
#include "hil/arm/start_tension.hpp"

namespace liana::bench {

ArmPhysics::ArmPhysics(const RobotConfig& robot, const SceneConfig& scene, const TrueParameters& truth,
                       const Theta& start_rad)
    : robot_(robot),
      scene_(scene),
      thetas_(robot.theta_count()),
      viscous_(robot.viscous_Nms_per_rad),
      chain_(robot, scene),
      paths_(robot, truth.hole_radius_error_m, truth.linkage),
      base_(robot),
      theta_(start_rad) {
  chain_.set_gravity(truth.gravity_m_s2);
  chain_.set_linkage(truth.linkage);
  chain_.place(theta_);
  paths_.update(theta_);
  Theta weight_Nm;
  chain_.bias(rate_, weight_Nm);
  const CableValues tension = balanced_tensions(paths_, thetas_, weight_Nm, kStartTensionOfPlan * robot.plan_tension_N,
                                                kStartFloorOfPlan * robot.plan_tension_N);
  for (std::size_t c = 0; c < paths_.cable_count(); ++c)
    lines_.emplace_back(paths_, c, robot.lead_m, truth.EA_N, truth.mu, tension[c]);
  base_.carry(theta_, weight_Nm);
  ThetaMatrix mass;
  chain_.inertia(mass);
  stable_step_s_ = stable_step_s(mass, stiffness(), viscous_, thetas_, kLongestStep_s);
}

ThetaMatrix ArmPhysics::stiffness() const {
  ThetaMatrix stiffness{};
  for (const CableLine& line : lines_) line.add_stiffness(paths_, stiffness);
  return stiffness;
}

CableValues ArmPhysics::payouts_m() const {
  CableValues payout{};
  for (std::size_t i = 0; i < base_.count(); ++i) payout[i] = base_.payout_m(i);
  for (std::size_t c = 0; c < lines_.size(); ++c) payout[base_.count() + c] = lines_[c].payout_m();
  return payout;
}

void ArmPhysics::settle_cables(const CableValues& payout_m) {
  for (std::size_t c = 0; c < lines_.size(); ++c) {
    max_sweeps_ = std::max(max_sweeps_, lines_[c].settle(paths_, payout_m[base_.count() + c]));
    record_.least_tension_N = std::min(record_.least_tension_N, lines_[c].least_tension_N());
    record_.min_motor_tension_N = std::min(record_.min_motor_tension_N, lines_[c].motor_tension_N());
    record_.max_motor_tension_N = std::max(record_.max_motor_tension_N, lines_[c].motor_tension_N());
  }
}

void ArmPhysics::pull(Theta& force) const {
  for (std::size_t c = 0; c < lines_.size(); ++c) {
    for (std::size_t j = paths_.first_segment(); j <= paths_.last_segment(c); ++j) {
      const double tension = lines_[c].segment_tension_N(j);
      force[2 * j] -= tension * paths_.path(c, j).d_pitch_m;
      force[2 * j + 1] -= tension * paths_.path(c, j).d_yaw_m;
    }
  }
}

void ArmPhysics::stop_at_limits(Theta& force, ThetaMatrix& damping, double step_s) const {
  for (std::size_t i = 0; i < thetas_; ++i) {
    const double limit = robot_.segments[i / 2].theta_limit_rad;
    const double beyond = theta_[i] - std::clamp(theta_[i], -limit, limit);
    if (beyond == 0.0) continue;
    force[i] -= kJointStop_Nm_per_rad * beyond;
    damping[i][i] += viscous_ + step_s * kJointStop_Nm_per_rad;
  }
}

void ArmPhysics::touch(double step_s, ContactLoad& load) {
  add_rod(scene_.rod, chain_, thetas_, load);
  for (const Push& push : pushes_) add_push(push, chain_, thetas_, load);
  if (near_contact_)
    for (const Contact& contact : chain_.contacts())
      add_contact(scene_.contact, chain_, contact, rate_, thetas_, step_s, load);
  record_.contact_N = std::max(record_.contact_N, load.largest_N);
  record_.rod_N = std::max(record_.rod_N, load.rod_N);
}

void ArmPhysics::step(double step_s, const CableValues& payout_m) {
  settle_cables(payout_m);
  ThetaMatrix mass;
  chain_.inertia(mass);
  Theta bias;
  chain_.bias(rate_, bias);
  ContactLoad load;
  touch(step_s, load);
  pull(load.force);
  stop_at_limits(load.force, load.damping, step_s);
  base_.add(theta_, mass, payout_m, step_s, load.force, load.damping);

  // (M + h D) v_new = M v + h (cables + contacts - bias): velocity first, damping implicit.
  Theta momentum{};
  for (std::size_t a = 0; a < thetas_; ++a) {
    momentum[a] = step_s * (load.force[a] - bias[a]);
    for (std::size_t b = 0; b < thetas_; ++b) momentum[a] += mass[a][b] * rate_[b];
    for (std::size_t b = 0; b < thetas_; ++b) load.damping[a][b] = mass[a][b] + step_s * load.damping[a][b];
    if (a >= base_.count()) load.damping[a][a] += step_s * viscous_;
  }
  if (!solve_spd(load.damping, momentum, thetas_, rate_))
    throw std::runtime_error("physics: the mass matrix is not positive; the state is broken");
  for (std::size_t a = 0; a < thetas_; ++a) theta_[a] += step_s * rate_[a];
  base_.settle(theta_, rate_);
  chain_.place(theta_);
  paths_.update(theta_);
}

double ArmPhysics::fastest_joint_m_s() const {
  // Every joint centre moves at most as fast as all angles together could swing the whole arm behind them.
  double fastest = 0.0;
  for (std::size_t i = 0; i <= chain_.link_count(); ++i) {
    PointJacobian jacobian;
    chain_.point_jacobian(std::min(i, chain_.link_count() - 1), chain_.joint_center_m(i), jacobian);
    Vec3 v;
    for (std::size_t k = 0; k < thetas_; ++k) v = v + rate_[k] * Vec3{jacobian[0][k], jacobian[1][k], jacobian[2][k]};
    fastest = std::max(fastest, norm(v));
  }
  return fastest;
}

void ArmPhysics::begin_slot(double duration_s) {
  // Collision detection costs as much as the rest, so it is left out while nothing can touch: three times the present
  // speed and half a millimetre are far beyond what cables change in one slot.
  constexpr double kReserve_m = 0.5e-3;
  const Clearance gap = clearance();
  const double reach = kReserve_m + 3.0 * duration_s * fastest_joint_m_s();
  near_contact_ = std::min({gap.slit_m, gap.sphere_m, gap.convex_m, gap.rod_m}) < reach;
  contact_slots_ += near_contact_ ? 1 : 0;
}

void ArmPhysics::remove_rod() {
  scene_.rod.pose.position_m = {kFarAway_m, 0.0, 0.0};
  chain_.remove_rod();
}

LoadRecord ArmPhysics::take_record() {
  const LoadRecord taken = record_;
  record_ = {};
  return taken;
}

double ArmPhysics::energy_J() {
  double energy = base_.energy_J();
  for (const auto& line : lines_) energy += line.energy_J();
  ThetaMatrix mass;
  chain_.inertia(mass);
  for (std::size_t a = 0; a < thetas_; ++a)
    for (std::size_t b = 0; b < thetas_; ++b) energy += 0.5 * mass[a][b] * rate_[a] * rate_[b];
  return energy;
}

void ArmPhysics::set_state(const Theta& theta_rad, const Theta& rate_rad_s) {
  theta_ = theta_rad;
  rate_ = rate_rad_s;
  chain_.place(theta_);
  paths_.update(theta_);
  base_.halt();
  base_.settle(theta_, rate_);
  settle_cables(payouts_m());
}

}  // namespace liana::bench
