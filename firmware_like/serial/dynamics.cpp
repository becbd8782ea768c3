// Luh, Walker, Paul: velocities and accelerations from the base to the tip, forces back; every vector in the frame of
// its link, where inertias stand still.
#include "firmware_like/serial/dynamics.hpp"

#include "firmware_like/math/trig.hpp"

namespace liana::serial {
namespace {

using Index = std::size_t;

// Acceleration of a point at `arm_m` of a body, less that of its origin.
Vec3 carried(const Vec3& rate, const Vec3& accel, const Vec3& arm_m) noexcept {
  return add(cross(accel, arm_m), cross(rate, cross(rate, arm_m)));
}

}  // namespace

Dynamics::Dynamics(const RobotParams& table, const MassTable& masses) noexcept : joints_(table.joints()) {
  for (Index i = 0; i < joints_; ++i) {
    const DhRow& row = table.joint[i].dh;
    const SinCos alpha = sin_cos(row.alpha_rad);
    const Vec3 axis{0.0, alpha.sin, alpha.cos};
    link_[i] = {alpha.sin,     alpha.cos, row.offset_rad, axis, add({row.a_m, 0.0, 0.0}, scale(axis, row.d_m)),
                masses.link[i]};
  }
  last_alone_ = link_[joints_ - 1].mass;
}

void Dynamics::set_payload(const LinkMass& payload_at_tip) noexcept {
  link_[joints_ - 1].mass = joined(last_alone_, payload_at_tip);
}

Dynamics::Turns Dynamics::turns_at(const JointVector& joint_rad) const noexcept {
  Turns turns;
  for (Index i = 0; i < joints_; ++i) {
    const SinCos theta = sin_cos(joint_rad[i] + link_[i].offset_rad);
    turns[i] = {theta.sin, theta.cos};
  }
  return turns;
}

// A vector of the frame before the link, in the link's frame.
Vec3 Dynamics::into_link(const Link& link, const Turn& turn, const Vec3& v) noexcept {
  const double across = turn.cos * v[1] - turn.sin * v[0];
  return {turn.cos * v[0] + turn.sin * v[1], link.cos_alpha * across + link.sin_alpha * v[2],
          link.cos_alpha * v[2] - link.sin_alpha * across};
}

Vec3 Dynamics::out_of_link(const Link& link, const Turn& turn, const Vec3& v) noexcept {
  const double across = link.cos_alpha * v[1] - link.sin_alpha * v[2];
  return {turn.cos * v[0] - turn.sin * across, turn.sin * v[0] + turn.cos * across,
          link.sin_alpha * v[1] + link.cos_alpha * v[2]};
}

JointVector Dynamics::recurse(const Turns& turns, const JointVector& rate_rad_s, const JointVector& accel_rad_s2,
                              const Wrench& on_tip, const Vec3& gravity_m_s2) const noexcept {
  std::array<Wrench, kMaxJoints> inertial;  // what it takes to move each link, about the origin of the frame before it
  Vec3 rate{}, accel{}, linear = scale(gravity_m_s2, -1.0);  // who falls freely feels nothing
  Vec3 force = scale(on_tip.force_N, -1.0), torque = scale(on_tip.torque_Nm, -1.0);
  for (Index i = 0; i < joints_; ++i) {
    const Link& link = link_[i];
    const Vec3 before = into_link(link, turns[i], rate);
    const Vec3 own = scale(link.axis, rate_rad_s[i]);
    rate = add(before, own);
    accel = add(add(into_link(link, turns[i], accel), scale(link.axis, accel_rad_s2[i])), cross(before, own));
    linear = add(into_link(link, turns[i], linear), carried(rate, accel, link.reach_m));
    const Vec3 center_accel = add(linear, carried(rate, accel, link.mass.center_m));
    const Vec3 push = scale(center_accel, link.mass.mass_kg);
    const Vec3 spin = add(inertia_times(link.mass, accel), cross(rate, inertia_times(link.mass, rate)));
    inertial[i] = {push, add(spin, cross(add(link.reach_m, link.mass.center_m), push))};
    force = into_link(link, turns[i], force);
    torque = into_link(link, turns[i], torque);
  }
  JointVector torque_Nm{};
  for (Index i = joints_; i-- > 0;) {
    const Link& link = link_[i];
    torque = add(add(torque, cross(link.reach_m, force)), inertial[i].torque_Nm);
    force = add(force, inertial[i].force_N);
    torque_Nm[i] = dot(torque, link.axis);
    force = out_of_link(link, turns[i], force);
    torque = out_of_link(link, turns[i], torque);
  }
  return torque_Nm;
}

JointVector Dynamics::torque_Nm(const JointMotion& motion, const Wrench& on_tip,
                                const Vec3& gravity_m_s2) const noexcept {
  return recurse(turns_at(motion.joint_rad), motion.rate_rad_s, motion.accel_rad_s2, on_tip, gravity_m_s2);
}

// Column by column: the torques of a unit acceleration from rest.
MassMatrix Dynamics::mass_matrix(const JointVector& joint_rad) const noexcept {
  const Turns turns = turns_at(joint_rad);
  MassMatrix M{};
  for (Index k = 0; k < M.size(); ++k) {
    M[k][k] = 1.0;
    if (k >= joints_) continue;
    JointVector accel{};
    accel[k] = 1.0;
    const JointVector column = recurse(turns, {}, accel, {}, {});
    for (Index i = k; i < joints_; ++i) M[i][k] = M[k][i] = column[i];
  }
  return M;
}

}  // namespace liana::serial
