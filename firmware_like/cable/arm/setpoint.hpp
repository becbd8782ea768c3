// What a device, mission, plan or client asks of a cable arm; not yet verified.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/command/telecommand.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana::cable {

constexpr std::int32_t kMaxNodeTargets = 4;
constexpr std::int32_t kMaxKeepClear = 4;

// Where a node (the end of a segment) should go in the null space of the tip (mission, A6).
struct NodeTarget {
  std::int32_t node = 0;     // 1 = end of segment 1; 0 = unused
  Vec3 position_m{};         // in the base frame
  double weight = 0.0;       // lambda_j >= 0
  double threshold_m = 0.0;  // acts only while the distance is larger
};

using NodeTargets = std::array<NodeTarget, kMaxNodeTargets>;

// A point that the arm's axis should keep its distance from: a sphere's centre, with radius + arm radius + margin.
struct KeepClear {
  Vec3 centre_m{};          // in the base frame
  double distance_m = 0.0;  // 0 = unused
  double weight = 0.0;      // against node targets; lambda of what is missing, per segment
};
using KeepClearTargets = std::array<KeepClear, kMaxKeepClear>;

// Weight of a target that names none: the arm's middle node comes first (requirement A45: d_3 of five segments).
constexpr double default_node_weight(const RobotParams& table, std::int32_t node) {
  return node == (table.segment_count + 1) / 2 ? 1.0 : 0.25;
}

struct Setpoint {
  CommandKind kind = CommandKind::kNone;
  Pose tip_in_base{};           // kTip
  std::uint32_t held_mask = 0;  // kTip: bit i holds theta i (0-based)
  ThetaVector held_rad{};       // kTip: where held variables go
  NodeTargets node{};           // kTip
  KeepClearTargets clear{};     // kTip
  ThetaVector joint_rad{};      // kJoint, kRetract
  double tip_speed_m_s = 0.0;   // kTip: limit for this motion, > 0, at most the robot's
  TipLoad payload{};            // all that move: what the arm carries beside its tool
  double dither_share = 0.0;    // while the arm is at rest: share by which all tensions go up and down (dither.hpp)
};

// An arm may be enabled where it stands a little beyond a limit, and moves from there: 0.75 deg. The motion stage leads
// no angle further out.
constexpr double kStandsBeyond_rad = 0.0131;

// Finite, with mass and centre within the constants of TipLoad.
bool is_usable(const TipLoad& load) noexcept;

// A setpoint the arm can use: finite, poses valid, angles inside the limits, those of joints but for kStandsBeyond_rad
// (the release step has checked the same; this is the second lock). Hold and stop always are.
bool is_usable(const RobotParams& table, const Setpoint& setpoint) noexcept;

}  // namespace liana::cable
