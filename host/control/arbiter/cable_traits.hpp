// The cable arm as ways of moving see it.
#pragma once

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/shape/keep_clear.hpp"
#include "firmware_like/cable_controller.hpp"
#include "host/control/arbiter/arm_traits.hpp"
#include "host/control/arbiter/start_ramp.hpp"

namespace liana::arbiter {

// Share of the theta acceleration limit that planned moves use. All thetas together swing the whole arm: 1 deg/s2 would
// take 100 N off a cable.
constexpr double kThetaAccelShare = 0.02;
constexpr double kFeedAccelShare = 0.2;  // of a base that feeds, whose drives hold it stiffly
// Shares of the tip's limits, after a goal far ahead.
constexpr double kGoalAccelShare = 0.45;
constexpr double kGoalSpeedShare = 0.8;

// Whether any entry is used.
bool has_nodes(const cable::NodeTargets& nodes);

// Besides the tip: held variables and the shape.
struct CableObjectives {
  std::uint32_t held_mask = 0;  // bit i: theta i is held at held_rad[i]
  cable::ThetaVector held_rad{};
  cable::NodeTargets nodes{};
  cable::KeepClearTargets clear{};
};

template <>
struct ArmTraits<cable::CableArm> {
  using Joints = cable::ThetaVector;
  using Wishes = CableObjectives;

  static std::size_t joint_count(const cable::RobotParams& table) {
    return static_cast<std::size_t>(table.theta_count());
  }
  static double rate_rad_s(const cable::RobotParams& table, std::size_t) { return table.limits.theta_rate_rad_s; }
  static double move_accel_rad_s2(const cable::RobotParams& table, std::size_t i) {
    return (i < static_cast<std::size_t>(table.feed_count()) ? kFeedAccelShare : kThetaAccelShare) *
           table.limits.theta_accel_rad_s2;
  }
  static JointRange range_rad(const cable::RobotParams& table, std::size_t theta) {
    const double max_rad = table.segment[theta / 2].theta_limit_rad;
    return {-max_rad, max_rad};
  }
  static constexpr const char* kJointName = "theta";
  static constexpr const char* kOtherWay = "Plan a way that keeps clear (liana plan)";
  static double apart_m(const cable::RobotParams& table, const Joints& a, const Joints& b);
  // Of the cables, by their lengths along the arm.
  static double drive_time_s(const cable::RobotParams& table, const Joints& a, const Joints& b);
  static TipBounds tip_bounds(const cable::RobotParams& table) {
    const cable::MotionLimits& l = table.limits;
    return {{l.tip_speed_m_s, l.tip_accel_m_s2, l.tip_jerk_m_s3},
            {l.tip_rate_rad_s, l.tip_angular_accel_rad_s2, l.tip_angular_jerk_rad_s3}};
  }
  // Of a tip that goes after a goal far ahead of it.
  static GoalRamp goal_ramp(const cable::RobotParams& table) {
    return {kGoalAccelShare * table.limits.tip_accel_m_s2, kGoalSpeedShare * table.limits.tip_speed_m_s};
  }
  static Pose tip_at(const cable::RobotParams& table, const Joints& theta_rad) {
    return cable::forward_kinematics(table, theta_rad).tip_in_base;
  }
  static const Joints& command_rad(const liana::Outputs<cable::CableArm>& now) { return now.theta_command_rad; }
  static const Joints& measured_rad(const liana::Outputs<cable::CableArm>& now) { return now.theta_measured_rad; }
  // Enabled without a cable that is lost.
  static bool recovers(const cable::RobotParams& table, const liana::Outputs<cable::CableArm>& now);
  static void add_wishes(const Wishes& wishes, cable::Setpoint& setpoint);
  // Where a shape is asked for, its null space has to come to rest, too.
  static bool has_arrived(const Wishes& wishes, const liana::Outputs<cable::CableArm>& now, bool tip_there);
};

}  // namespace liana::arbiter
