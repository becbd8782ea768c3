#include "hil/arm/kinematic_arm.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hil/arm/start_tension.hpp"

namespace liana::bench {

namespace {

// One step never turns an angle further: with slack cables, little else holds it.
constexpr double kMaxTurn_rad = 0.01;

Quat turned(double angle_rad, const Vec3& axis) {
  const double s = std::sin(0.5 * angle_rad);
  return {std::cos(0.5 * angle_rad), s * axis.x, s * axis.y, s * axis.z};
}

}  // namespace

Pose tip_of(const RobotConfig& robot, const Theta& theta_rad) {
  Pose tip;
  if (robot.base) tip = {{robot.base->slide_m_per_rad * theta_rad[0], 0.0, 0.0}, turned(theta_rad[1], {1.0, 0.0, 0.0})};
  for (std::size_t s = 0; s < robot.segments.size(); ++s) {
    const Quat pitch = turned(theta_rad[2 * s], {0.0, 0.0, 1.0});
    const Quat yaw = turned(theta_rad[2 * s + 1], {0.0, 1.0, 0.0});
    const Quat joint[2] = {pitch * yaw, yaw * pitch};
    const Vec3 link{robot.segments[s].module_length_m, 0.0, 0.0};
    for (int i = 0; i < robot.segments[s].modules; ++i) {
      tip.attitude = tip.attitude * joint[i % 2];
      tip.position_m = tip.position_m + rotate(tip.attitude, link);
    }
  }
  return tip;
}

KinematicArm::KinematicArm(const RobotConfig& robot, const TrueParameters& truth, const Theta& start_rad)
    : robot_(robot),
      thetas_(robot.theta_count()),
      EA_N_(truth.EA_N),
      paths_(robot, truth.hole_radius_error_m),
      base_(robot),
      theta_(start_rad),
      tip_(tip_of(robot, start_rad)) {
  if (truth.mu != 0.0)
    throw std::runtime_error("--arm light has no friction in its cables; give --physics ideal, or --arm full");
  if (norm(truth.gravity_m_s2) != 0.0 || !truth.linkage.empty())
    throw std::runtime_error("--arm light has neither weight nor an uneven linkage; leave these out, or --arm full");
  paths_.update(theta_);
  const CableValues tension = balanced_tensions(paths_, thetas_, Theta{}, kStartTensionOfPlan * robot.plan_tension_N,
                                                kStartFloorOfPlan * robot.plan_tension_N);
  for (std::size_t i = 0; i < base_.count(); ++i) payout_[i] = base_.payout_m(i, theta_[i]);
  for (std::size_t c = 0; c < paths_.cable_count(); ++c)
    payout_[base_.count() + c] = (paths_.length_m(c) + robot_.lead_m) / (1.0 + tension[c] / EA_N_);
  stretch();
  note_extremes();
}

// Tensions of the present angles and payouts; a cable that is too long is slack.
void KinematicArm::stretch() {
  for (std::size_t c = 0; c < paths_.cable_count(); ++c) {
    const double stretched_m = paths_.length_m(c) + robot_.lead_m - payout_m(c);
    tension_N_[c] = std::max(0.0, EA_N_ * stretched_m / payout_m(c));
  }
}

void KinematicArm::note_extremes() {
  for (std::size_t c = 0; c < paths_.cable_count(); ++c) {
    record_.least_tension_N = std::min(record_.least_tension_N, tension_N_[c]);
    record_.max_motor_tension_N = std::max(record_.max_motor_tension_N, tension_N_[c]);
  }
  record_.min_motor_tension_N = record_.least_tension_N;  // without friction a cable has one tension everywhere
}

// What cables and joint stops do to the angles, and how it changes with them.
void KinematicArm::pull(Theta& torque, ThetaMatrix& stiffness) const {
  for (std::size_t c = 0; c < paths_.cable_count(); ++c) {
    if (tension_N_[c] == 0.0) continue;
    const double k_N_per_m = EA_N_ / payout_m(c);
    const std::size_t angles = 2 * (paths_.last_segment(c) + 1);
    Theta row{};
    for (std::size_t j = paths_.first_segment(); 2 * j < angles; ++j) {
      row[2 * j] = paths_.path(c, j).d_pitch_m;
      row[2 * j + 1] = paths_.path(c, j).d_yaw_m;
    }
    for (std::size_t a = 0; a < angles; ++a) {
      torque[a] -= row[a] * tension_N_[c];
      for (std::size_t b = 0; b <= a; ++b) stiffness[a][b] += k_N_per_m * row[a] * row[b];
    }
  }
  for (std::size_t i = base_.count(); i < thetas_; ++i) {
    const double limit = robot_.segments[i / 2].theta_limit_rad;
    const double beyond = theta_[i] - std::clamp(theta_[i], -limit, limit);
    if (beyond == 0.0) continue;
    torque[i] -= kJointStop_Nm_per_rad * beyond;
    stiffness[i][i] += kJointStop_Nm_per_rad;
  }
}

void KinematicArm::follow_base(double step_s) {
  for (std::size_t i = 0; i < base_.count(); ++i) {
    const double angle_rad = base_.angle_rad(i, payout_[i]);
    rate_[i] = (angle_rad - theta_[i]) / step_s;
    theta_[i] = angle_rad;
  }
}

void KinematicArm::step(double step_s, const CableValues& payout_m) {
  payout_ = payout_m;
  stretch();
  Theta torque{};
  ThetaMatrix stiffness{};  // the lower triangle, which is all that the solver reads
  pull(torque, stiffness);
  for (std::size_t a = 0; a < base_.count(); ++a) stiffness[a][a] = 1.0;  // no torque: none turns
  for (std::size_t a = base_.count(); a < thetas_; ++a) stiffness[a][a] += robot_.viscous_Nms_per_rad / step_s;
  Theta turn{};
  if (!solve_spd(stiffness, torque, thetas_, turn))
    throw std::runtime_error("light arm: no step is possible; the state is broken");
  for (std::size_t a = base_.count(); a < thetas_; ++a) {
    const double limited = std::clamp(turn[a], -kMaxTurn_rad, kMaxTurn_rad);
    theta_[a] += limited;
    rate_[a] = limited / step_s;
  }
  follow_base(step_s);
  paths_.update(theta_);
  tip_ = tip_of(robot_, theta_);
  stretch();
  note_extremes();
}

Clearance KinematicArm::clearance() const { return {kFarAway_m, kFarAway_m, kFarAway_m}; }

LoadRecord KinematicArm::take_record() {
  const LoadRecord taken = record_;
  record_ = {};
  return taken;
}

}  // namespace liana::bench
