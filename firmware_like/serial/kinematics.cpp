#include "firmware_like/serial/kinematics.hpp"

#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana::serial {
namespace {

using Index = std::size_t;

Quat turn_about_z(double angle_rad) noexcept {
  const SinCos half = sin_cos(0.5 * angle_rad);
  return {half.cos, 0.0, 0.0, half.sin};
}

Quat turn_about_x(double angle_rad) noexcept {
  const SinCos half = sin_cos(0.5 * angle_rad);
  return {half.cos, half.sin, 0.0, 0.0};
}

// The link of `row` behind a joint at `joint_rad`: from the frame before the joint to the frame at the link's end.
Pose behind_joint(const DhRow& row, double joint_rad, const Pose& before) noexcept {
  const Quat turned = multiply(before.quaternion, turn_about_z(joint_rad + row.offset_rad));
  return {add(before.position_m, rotate(turned, {row.a_m, 0.0, row.d_m})),
          multiply(turned, turn_about_x(row.alpha_rad))};
}

}  // namespace

ArmKinematics forward_kinematics(const RobotParams& table, const JointVector& joint_rad) noexcept {
  ArmKinematics arm;
  Jacobian& J = arm.tip_jacobian;
  Pose frame;
  for (Index i = 0; i < table.joints(); ++i) {
    J.angular[i] = rotate(frame.quaternion, {0.0, 0.0, 1.0});
    frame = behind_joint(table.joint[i].dh, joint_rad[i], frame);
    arm.point_in_base[i + 1] = frame.position_m;
  }
  for (Index i = 0; i < table.joints(); ++i)
    J.linear[i] = cross(J.angular[i], subtract(frame.position_m, arm.point_in_base[i]));
  arm.tip_in_base = {frame.position_m, normalize(frame.quaternion)};
  return arm;
}

Twist tip_twist(const RobotParams& table, const Jacobian& jacobian, const JointVector& rate_rad_s) noexcept {
  Twist twist;
  for (Index i = 0; i < table.joints(); ++i) {
    twist.linear_m_s = add(twist.linear_m_s, scale(jacobian.linear[i], rate_rad_s[i]));
    twist.angular_rad_s = add(twist.angular_rad_s, scale(jacobian.angular[i], rate_rad_s[i]));
  }
  return twist;
}

JointVector torque_of_wrench(const RobotParams& table, const Jacobian& jacobian, const Wrench& wrench) noexcept {
  JointVector torque_Nm{};
  for (std::size_t i = 0; i < table.joints(); ++i) {
    torque_Nm[i] = dot(jacobian.linear[i], wrench.force_N) + dot(jacobian.angular[i], wrench.torque_Nm);
  }
  return torque_Nm;
}

double chain_length_m(const RobotParams& table) noexcept {
  double length_m = 0.0;
  for (Index i = 0; i < table.joints(); ++i) {
    const DhRow& row = table.joint[i].dh;
    length_m += std::sqrt(row.a_m * row.a_m + row.d_m * row.d_m);
  }
  return length_m;
}

}  // namespace liana::serial
