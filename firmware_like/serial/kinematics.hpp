// Forward kinematics and geometric Jacobian of a chain of revolute joints, from its DH table.
#pragma once

#include <array>

#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/robot_params.hpp"
#include "firmware_like/serial/wrench.hpp"

namespace liana::serial {

// Columns are joints; linear m/rad, angular rad/rad, of the tip in the base frame (6 x joint_count).
struct Jacobian {
  std::array<Vec3, kMaxJoints> linear{};
  std::array<Vec3, kMaxJoints> angular{};
};

struct ArmKinematics {
  std::array<Vec3, kMaxJoints + 1> point_in_base{};  // [i]: origin of DH frame i; [joint_count] is the tip's
  Pose tip_in_base{};
  Jacobian tip_jacobian{};
};

// Points, tip and Jacobian at the joint angles [rad], |.| <= 1000. Cost: one pass over the joints, about 150 operations
// each.
ArmKinematics forward_kinematics(const RobotParams& table, const JointVector& joint_rad) noexcept;

// Velocity of the tip in the base frame.
struct Twist {
  Vec3 linear_m_s{};
  Vec3 angular_rad_s{};
};
Twist tip_twist(const RobotParams& table, const Jacobian& jacobian, const JointVector& rate_rad_s) noexcept;

// J^T F: joint torques [N.m] that give this wrench at the tip, about its origin, in the base frame.
JointVector torque_of_wrench(const RobotParams& table, const Jacobian& jacobian, const Wrench& wrench) noexcept;

// Distance from the base [m] that no tip of this arm is beyond: the links laid end to end.
double chain_length_m(const RobotParams& table) noexcept;

}  // namespace liana::serial
