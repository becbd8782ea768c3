// Forward kinematics and reduced Jacobian of the equal-angle arm, in closed form (mission, A1 and A2).
//
// A segment of n modules bent by (pitch a, yaw b) is planar: with w = cos a cos b = cos psi, y = sin b, z = sin a cos
// b, link k points along T_k(w) e_x + U_(k-1)(w) (0, z, -y) (Chebyshev polynomials), in the frame of the segment's
// root.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana::cable {

// Trigonometry of one segment's two angles, shared by kinematics and cables. A base that feeds (robot_params.hpp) has
// its slide [rad] in place of the pitch's sine and its roll [rad] in place of the cosine.
struct SegmentTrig {
  double sin_pitch, cos_pitch, sin_yaw, cos_yaw;
};

using ArmTrig = std::array<SegmentTrig, kMaxSegments>;

// Sine and cosine of all angles; theta in radians, any size within 1000.
void update_trig(const RobotParams& table, const ThetaVector& theta_rad,
                 ArmTrig& trig) noexcept;  // all that the table uses is written
ArmTrig arm_trig(const RobotParams& table, const ThetaVector& theta_rad) noexcept;

// Columns are thetas; linear m/rad, angular rad/rad, of one point in the base frame.
struct Jacobian {
  std::array<Vec3, kMaxTheta> linear{};
  std::array<Vec3, kMaxTheta> angular{};
};

// [0] = base, where it has been fed to, [m] = end of segment m; the last one is the tip.
using NodePoses = std::array<Pose, kMaxSegments + 1>;

struct ArmKinematics {
  NodePoses node_in_base{};
  Pose tip_in_base{};
  Jacobian tip_jacobian{};  // 6 x theta_count
};

// Pose of every node and the 6x10 Jacobian of the tip. Cost: one closed form per segment, no loop over modules beyond
// the Chebyshev sums; derived in docs/explanation/kinematics.md.
void update_kinematics(const RobotParams& table, const ArmTrig& trig,
                       ArmKinematics& out) noexcept;  // all that the table uses is written
ArmKinematics forward_kinematics(const RobotParams& table, const ArmTrig& trig) noexcept;
ArmKinematics forward_kinematics(const RobotParams& table, const ThetaVector& theta_rad) noexcept;

// Pose of the tip alone, at half the cost.
Pose tip_pose(const RobotParams& table, const ArmTrig& trig) noexcept;

// Linear Jacobian column of node `node` (1..segment_count) for theta `column`; zero for segments beyond the node.
Vec3 node_jacobian_column(const ArmKinematics& kinematics, std::int32_t node, std::int32_t column) noexcept;

// Joint centres and link ends of the whole arm: point 0 is the base, where it has been fed to, point i the end of link
// i (module i).
struct LinkPoints {
  std::array<Vec3, kMaxSegments * kMaxModules + 1> point_in_base{};
  std::int32_t count = 0;  // links + 1

  std::span<const Vec3> axis() const { return {point_in_base.data(), static_cast<std::size_t>(count)}; }
};
LinkPoints link_points(const RobotParams& table, const ThetaVector& theta_rad) noexcept;

}  // namespace liana::cable
