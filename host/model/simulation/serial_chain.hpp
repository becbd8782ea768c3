// Kinematics of the simulation for a serial arm: one row of its table after another, as matrices. It shares no code
// with the core's, so that a mistake in one shows.
#pragma once

#include <array>

#include "host/model/simulation/serial_model.hpp"

namespace liana::simulation {

// A link is two straight pieces, along the joint's axis (d) and along the link (a); either may have no length.
constexpr std::int32_t kPiecesPerLink = 2;
constexpr std::size_t kMaxSerialPoints = kPiecesPerLink * serial::kMaxJoints + 1;

// The axis of a serial arm: point 0 is its base, points 2 i - 1 and 2 i are the ends of the pieces of link i, counted
// from 1. Base frame [m].
struct SerialAxis {
  std::size_t count = 0;
  std::array<Vec3, kMaxSerialPoints> point_m{};
  std::array<Vec3, 3> tip_axis{};  // directions of the tip's x, y and z

  clearance::AxisPoints points() const { return {point_m.data(), count}; }
  const Vec3& tip_m() const { return point_m[count - 1]; }
  Vec3 beyond_tip_m(double along_z_m) const { return add(tip_m(), scale(tip_axis[2], along_z_m)); }
};

// The axis at these joint angles [rad]. About 2,000 instructions.
SerialAxis serial_axis(const serial::RobotParams& table, const serial::JointVector& joint_rad);

// Length [m] of the whole axis, which is that of all pieces.
double axis_length_m(const serial::RobotParams& table);

}  // namespace liana::simulation
