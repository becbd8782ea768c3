// The arm as this room sees it, of either kind: angles within ranges, points along it, and how the angles move those.
//
// Points are counted from the base: 0 is the base itself, the last one is the tip. A cable arm has one at the end of
// every segment, a serial arm one at the end of every joint's link (joint_points_m of `liana pose`).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::workspace {

constexpr std::int32_t kMaxAngles = cable::kMaxTheta;
constexpr std::int32_t kMaxNodes = std::max(cable::kMaxSegments, serial::kMaxJoints);
static_assert(serial::kMaxJoints <= kMaxAngles);

using AngleVector = std::array<double, kMaxAngles>;  // from the base to the tip [rad]; 0 beyond those of the arm

// Where an angle may be [rad]; low <= high, both 0 beyond those of the arm.
struct AngleRange {
  double low_rad = 0.0;
  double high_rad = 0.0;
};

// True when the range holds a whole turn (up to 1e-9 rad). Then it keeps no point from anywhere: what is reached beyond
// an end is reached a turn before it, too.
bool holds_a_turn(const AngleRange& range);

// The middle of the range [rad].
double middle_rad(const AngleRange& range);

// How far from the middle poses are drawn [rad]: half the range, or half a turn when it holds a turn, so that no place
// is drawn more often because the joint can come to it twice.
double drawn_half_rad(const AngleRange& range);

// An angle within its range as it is; else at the nearer end, or, when the range holds a turn, by whole turns to within
// half a turn of the middle.
double into_range(const AngleRange& range, double angle_rad);

// Where a point is, and its velocity per angle rate; columns of angles beyond the point are 0.
struct PointMotion {
  Vec3 point_in_base_m{};
  std::array<Vec3, kMaxAngles> column{};  // m/rad
};

// All that reach asks of an arm. The functions hold a copy of the robot's table, may be called from any thread, and
// cost one forward kinematics each.
struct ReachArm {
  std::string_view angle_name;   // "theta" or "joint", as users know it
  std::string_view node_name;    // "node" or "point"
  std::string_view length_name;  // what the sum of link_m is
  std::int32_t angle_count = 0;
  std::int32_t node_count = 0;    // the tip's number
  bool is_straight_at_0 = false;  // with all angles at 0 the arm reaches farthest: half of the poses are drawn near it
  std::array<AngleRange, kMaxAngles> range{};
  std::array<std::int32_t, kMaxNodes + 1> angles_to{};  // [m]: angles that move point m, those before this number
  std::array<double, kMaxNodes + 1> link_m{};           // [m]: longest distance of point m from point m - 1
  std::function<PointMotion(std::int32_t node, const AngleVector& angle_rad)> motion;  // of node 0..node_count
  std::function<std::vector<Vec3>(const AngleVector& angle_rad)> centre_line;  // in the base frame [m], to draw the arm
};

// The two kinds of arm. They allocate; tables need no checks beyond the loader's.
ReachArm arm_of(const cable::RobotParams& table);
ReachArm arm_of(const serial::RobotParams& table);

// The angles of a serial arm among those of any arm [rad].
AngleVector angles_of(const serial::JointVector& joint_rad);

}  // namespace liana::workspace
