#include "host/planning/workspace/arm.hpp"

#include <cmath>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/math/trig.hpp"
#include "firmware_like/serial/kinematics.hpp"

namespace liana::workspace {
namespace {

using Index = std::size_t;

constexpr double kWholeTurn_rad = 2.0 * kPi;
constexpr double kTurnTolerance_rad = 1e-9;  // degrees that went through radians are a turn still

PointMotion motion_of(const cable::RobotParams& table, std::int32_t node, const AngleVector& theta_rad) {
  const cable::ArmKinematics arm = forward_kinematics(table, theta_rad);
  PointMotion motion;
  motion.point_in_base_m = arm.node_in_base[static_cast<Index>(node)].position_m;
  for (std::int32_t i = 0; i < 2 * node; ++i) motion.column[static_cast<Index>(i)] = node_jacobian_column(arm, node, i);
  return motion;
}

PointMotion motion_of(const serial::RobotParams& table, std::int32_t node, const AngleVector& angle_rad) {
  serial::JointVector joint_rad{};
  std::copy_n(angle_rad.begin(), joint_rad.size(), joint_rad.begin());
  const serial::ArmKinematics arm = forward_kinematics(table, joint_rad);
  PointMotion motion;
  motion.point_in_base_m = arm.point_in_base[static_cast<Index>(node)];
  for (Index i = 0; i < static_cast<Index>(node); ++i) {
    const Vec3 lever_m = subtract(motion.point_in_base_m, arm.point_in_base[i]);
    motion.column[i] = cross(arm.tip_jacobian.angular[i], lever_m);
  }
  return motion;
}

}  // namespace

bool holds_a_turn(const AngleRange& range) {
  return range.high_rad - range.low_rad >= kWholeTurn_rad - kTurnTolerance_rad;
}

double middle_rad(const AngleRange& range) { return 0.5 * (range.low_rad + range.high_rad); }

double drawn_half_rad(const AngleRange& range) {
  return holds_a_turn(range) ? 0.5 * kWholeTurn_rad : 0.5 * (range.high_rad - range.low_rad);
}

double into_range(const AngleRange& range, double angle_rad) {
  const double kept = clamp(angle_rad, range.low_rad, range.high_rad);
  if (kept == angle_rad || !holds_a_turn(range)) return kept;
  const double middle = middle_rad(range);
  return clamp(middle + std::remainder(angle_rad - middle, kWholeTurn_rad), range.low_rad, range.high_rad);
}

ReachArm arm_of(const cable::RobotParams& table) {
  ReachArm arm;
  arm.angle_name = "theta";
  arm.node_name = "node";
  arm.length_name = "straight arm";
  arm.angle_count = table.theta_count();
  arm.node_count = table.segment_count;
  arm.is_straight_at_0 = true;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    const cable::SegmentParams& segment = table.segment[m];
    arm.range[2 * m] = arm.range[2 * m + 1] = {-segment.theta_limit_rad, segment.theta_limit_rad};
    arm.angles_to[m + 1] = static_cast<std::int32_t>(2 * (m + 1));
    arm.link_m[m + 1] = segment.modules * segment.module_length_m + segment.slide_m_rad * segment.theta_limit_rad;
  }
  arm.motion = [table](std::int32_t node, const AngleVector& theta_rad) { return motion_of(table, node, theta_rad); };
  arm.centre_line = [table](const AngleVector& theta_rad) {
    const cable::LinkPoints links = link_points(table, theta_rad);
    return std::vector<Vec3>(links.axis().begin(), links.axis().end());
  };
  return arm;
}

ReachArm arm_of(const serial::RobotParams& table) {
  ReachArm arm;
  arm.angle_name = "joint";
  arm.node_name = "point";
  arm.length_name = "links end to end";
  arm.angle_count = arm.node_count = table.joint_count;
  for (Index i = 0; i < table.joints(); ++i) {
    arm.range[i] = {table.joint[i].low_rad, table.joint[i].high_rad};
    arm.angles_to[i + 1] = static_cast<std::int32_t>(i + 1);
    arm.link_m[i + 1] = norm({table.joint[i].dh.a_m, 0.0, table.joint[i].dh.d_m});
  }
  arm.motion = [table](std::int32_t node, const AngleVector& angle_rad) { return motion_of(table, node, angle_rad); };
  arm.centre_line = [table](const AngleVector& angle_rad) {
    std::vector<Vec3> points;
    for (std::int32_t node = 0; node <= table.joint_count; ++node)
      points.push_back(motion_of(table, node, angle_rad).point_in_base_m);
    return points;
  };
  return arm;
}

AngleVector angles_of(const serial::JointVector& joint_rad) {
  AngleVector angle_rad{};
  std::copy(joint_rad.begin(), joint_rad.end(), angle_rad.begin());
  return angle_rad;
}

}  // namespace liana::workspace
