// What the core is asked to do, and how a released request looks.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware_like/arm/robot_table.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana {

constexpr std::int32_t kMaxNodeTargets = 4;
constexpr std::int32_t kMaxKeepClear = 4;

enum class CommandKind : std::uint8_t {
  kNone = 0,   // nothing new this tick
  kTip = 1,    // tip pose, held variables, node targets
  kJoint = 2,  // joint angles
  kHold = 3,   // stop along the path, stay enabled
  kStop = 4,   // stop, then brakes, then disable
};

// Where a node (the end of a segment) should go in the null space of the tip (mission figure A6).
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

// Weight of a target that names none: the arm's middle node comes first (A45: d_3 of five segments).
constexpr double default_node_weight(const RobotTable& table, std::int32_t node) {
  return node == (table.segment_count + 1) / 2 ? 1.0 : 0.25;
}

// What a device, mission, plan or client asks for; not yet verified.
struct Setpoint {
  CommandKind kind = CommandKind::kNone;
  Pose tip_in_base{};           // kTip
  std::uint32_t held_mask = 0;  // kTip: bit i holds theta i (0-based)
  ThetaVector held_rad{};       // kTip: where held variables go
  NodeTargets node{};           // kTip
  KeepClearTargets clear{};     // kTip
  ThetaVector joint_rad{};      // kJoint
  double tip_speed_m_s = 0.0;   // kTip: limit for this motion, > 0, at most the robot's
};

// A verified setpoint with identity and life time. Only the release step (and the reader of recordings) can make one.
class Telecommand {
 public:
  constexpr Telecommand() = default;  // none

  std::uint64_t sequence() const { return sequence_; }
  std::uint64_t first_tick() const { return first_tick_; }
  std::uint64_t expiry_tick() const { return expiry_tick_; }  // first tick at which it no longer holds
  std::uint32_t owner() const { return owner_; }
  const Setpoint& setpoint() const { return setpoint_; }

 private:
  friend class Release;           // host/daemon: after both verdicts
  friend class RecordingDecoder;  // host/record: replay of what was released
  constexpr Telecommand(std::uint64_t sequence, std::uint64_t first_tick, std::uint64_t expiry_tick, std::uint32_t owner,
                        const Setpoint& setpoint)
      : sequence_(sequence), first_tick_(first_tick), expiry_tick_(expiry_tick), owner_(owner), setpoint_(setpoint) {}

  std::uint64_t sequence_ = 0;
  std::uint64_t first_tick_ = 0;
  std::uint64_t expiry_tick_ = 0;
  std::uint32_t owner_ = 0;
  std::uint32_t no_padding_ = 0;  // images of a Controller are recorded as memory: no byte of it may be left to chance
  Setpoint setpoint_{};
};

static_assert(std::is_trivially_copyable_v<Telecommand>);

}  // namespace liana
