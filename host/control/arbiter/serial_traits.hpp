// The serial arm as ways of moving see it.
#pragma once

#include <algorithm>
#include <limits>

#include "firmware_like/serial_controller.hpp"
#include "host/control/arbiter/arm_traits.hpp"
#include "host/control/arbiter/start_ramp.hpp"

namespace liana::arbiter {

// Share of a joint's acceleration limit that planned moves use; the rest is for the limiter that follows them.
constexpr double kJointAccelShare = 0.5;

// Besides the tip there is nothing to ask for.
struct NoObjectives {};

template <>
struct ArmTraits<serial::SerialArm> {
  using Joints = serial::JointVector;
  using Wishes = NoObjectives;

  static std::size_t joint_count(const serial::RobotParams& table) { return table.joints(); }
  static double rate_rad_s(const serial::RobotParams& table, std::size_t joint) {
    return table.joint[joint].rate_rad_s;
  }
  static double move_accel_rad_s2(const serial::RobotParams& table, std::size_t joint) {
    return kJointAccelShare * table.joint[joint].accel_rad_s2;
  }
  static JointRange range_rad(const serial::RobotParams& table, std::size_t joint) {
    return {table.joint[joint].low_rad, table.joint[joint].high_rad};
  }
  static constexpr const char* kJointName = "joint";
  static constexpr const char* kOtherWay = "Go through points that keep clear (move_path)";
  static double apart_m(const serial::RobotParams& table, const Joints& a, const Joints& b) {
    const serial::ArmKinematics from = serial::forward_kinematics(table, a), to = serial::forward_kinematics(table, b);
    double most_m = 0.0;
    for (std::size_t i = 0; i <= table.joints(); ++i)
      most_m = std::max(most_m, norm(subtract(to.point_in_base[i], from.point_in_base[i])));
    return most_m;
  }
  static double drive_time_s(const serial::RobotParams&, const Joints&, const Joints&) { return 0.0; }
  static TipBounds tip_bounds(const serial::RobotParams& table) {
    const serial::TipLimits& l = table.tip;
    return {{l.speed_m_s, l.accel_m_s2, l.jerk_m_s3}, {l.rate_rad_s, l.angular_accel_rad_s2, l.angular_jerk_rad_s3}};
  }
  // It does not swing.
  static GoalRamp goal_ramp(const serial::RobotParams&) {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    return {kAny, kAny};
  }
  static Pose tip_at(const serial::RobotParams& table, const Joints& joint_rad) {
    return serial::forward_kinematics(table, joint_rad).tip_in_base;
  }
  static const Joints& command_rad(const liana::Outputs<serial::SerialArm>& now) { return now.joint_command_rad; }
  static const Joints& measured_rad(const liana::Outputs<serial::SerialArm>& now) { return now.joint_measured_rad; }
  static bool recovers(const serial::RobotParams&, const liana::Outputs<serial::SerialArm>&) { return false; }
  static void add_wishes(const Wishes&, serial::Setpoint&) {}
  static bool has_arrived(const Wishes&, const liana::Outputs<serial::SerialArm>&, bool tip_there) { return tip_there; }
};
static_assert(SupportedArm<serial::SerialArm>);

}  // namespace liana::arbiter
