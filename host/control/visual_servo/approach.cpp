#include "host/control/visual_servo/approach.hpp"

#include <algorithm>
#include <cmath>

namespace liana::visual_servo {

namespace {

Vec3 towards(const Vec3& error, double gain_1_s, double accel, double speed) {
  const double away = norm(error);
  return away > 0.0 ? scale(error, approach_speed(away, gain_1_s, accel, speed) / away) : Vec3{};
}

// `from` changed towards `to` by at most `most`.
Vec3 stepped(const Vec3& from, const Vec3& to, double most) {
  const Vec3 change = subtract(to, from);
  const double length = norm(change);
  return length > most ? add(from, scale(change, most / length)) : to;
}

}  // namespace

PoseError error_between(const Pose& target_in_base, const Pose& goal, const Pose& tip) {
  const Quat to_target = conjugate(target_in_base.quaternion);
  return {rotate(to_target, subtract(goal.position_m, tip.position_m)),
          rotate(to_target, turn_between(tip.quaternion, goal.quaternion))};
}

// Where v = k e would brake harder than `accel`, the speed falls evenly with it instead: both meet at accel / k^2.
double approach_speed(double away, double gain_1_s, double accel, double speed) {
  const double meet = accel / (gain_1_s * gain_1_s);
  const double towards_it = away <= meet ? gain_1_s * away : std::sqrt(2.0 * accel * (away - 0.5 * meet));
  return std::min(towards_it, speed);
}

Pose Approach::next(const Pose& target_in_base, const Pose& goal, const Pose& tip_measured, const Pose& tip_command,
                    double dt_s) {
  const PoseError left = error_between(target_in_base, goal, asked_);
  const PoseError& sag = follow_sag(error_between(target_in_base, tip_command, tip_measured), dt_s);
  const Vec3 m = add(left.m, sag.m), rad = add(left.rad, sag.rad);
  const ApproachLimits& l = limits_;
  Vec3 along{};
  along[l.axis] = m[l.axis];
  const Vec3 axial = towards(along, l.gain_1_s, l.accel_m_s2, l.speed_m_s);
  const Vec3 lateral = towards(subtract(m, along), l.gain_1_s, l.accel_m_s2, l.lateral_speed_m_s);
  const Vec3 turn = towards(rad, l.gain_1_s, l.angular_accel_rad_s2, l.rate_rad_s);
  const Quat& to_base = target_in_base.quaternion;
  return move(rotate(to_base, add(axial, lateral)), rotate(to_base, turn), dt_s);
}

const PoseError& Approach::follow_sag(const PoseError& sag, double dt_s) {
  if (!sag_ || limits_.sag_tau_s <= dt_s) return sag_.emplace(sag);
  const double share = dt_s / limits_.sag_tau_s;
  sag_->m = add(sag_->m, scale(subtract(sag.m, sag_->m), share));
  sag_->rad = add(sag_->rad, scale(subtract(sag.rad, sag_->rad), share));
  return *sag_;
}

Pose Approach::brake(double dt_s) { return move({}, {}, dt_s); }

Pose Approach::move(const Vec3& wished_m_s, const Vec3& wished_rad_s, double dt_s) {
  velocity_m_s_ = stepped(velocity_m_s_, wished_m_s, limits_.accel_m_s2 * dt_s);
  rate_rad_s_ = stepped(rate_rad_s_, wished_rad_s, limits_.angular_accel_rad_s2 * dt_s);
  asked_.position_m = add(asked_.position_m, scale(velocity_m_s_, dt_s));
  asked_.quaternion = normalize(multiply(quaternion_of(scale(rate_rad_s_, dt_s)), asked_.quaternion));
  return asked_;
}

}  // namespace liana::visual_servo
