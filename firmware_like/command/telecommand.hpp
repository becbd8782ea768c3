// How a released setpoint looks: what every arm's setpoint has, and the telecommand around it.
#pragma once

#include <cstdint>
#include <type_traits>

namespace liana {

enum class CommandKind : std::uint8_t {
  kNone = 0,     // nothing new this tick
  kTip = 1,      // a tip pose, and what the arm should do beside it
  kJoint = 2,    // joint angles
  kHold = 3,     // stop along the path, stay enabled
  kStop = 4,     // stop, then brakes, then disable
  kRetract = 5,  // joint angles on the way out: slowly (kRetractRateShare), also while faults are latched that allow it
  kPush = 6,     // a set force along an axis of the tip; the rest follows from what is felt
  kFollow = 7,   // joints give way to what pushes them, and stay where nothing does
};

// Share of the joints' rate limits at which a retract moves at most.
constexpr double kRetractRateShare = 0.25;

// True for the kinds that carry joint angles.
constexpr bool is_joint(CommandKind kind) noexcept {
  return kind == CommandKind::kJoint || kind == CommandKind::kRetract;
}

// True for the kinds in which forces say where the arm goes.
constexpr bool is_force(CommandKind kind) noexcept {
  return kind == CommandKind::kPush || kind == CommandKind::kFollow;
}

// True for the kinds that carry a goal, which the arm judges and follows.
constexpr bool is_motion(CommandKind kind) noexcept {
  return kind == CommandKind::kTip || is_joint(kind) || is_force(kind);
}

// A verified setpoint with identity and life time. `Setpoint` is the arm's own type; it has a CommandKind `kind`. Only
// Release makes one.
template <class Setpoint>
class Telecommand {
 public:
  constexpr Telecommand() = default;  // none

  std::uint64_t sequence() const { return sequence_; }
  std::uint64_t first_tick() const { return first_tick_; }
  std::uint64_t expiry_tick() const { return expiry_tick_; }  // first tick at which it no longer holds
  std::uint32_t owner() const { return owner_; }
  CommandKind kind() const { return setpoint_.kind; }
  const Setpoint& setpoint() const { return setpoint_; }

 private:
  friend class Release;
  constexpr Telecommand(std::uint64_t sequence, std::uint64_t first_tick, std::uint64_t expiry_tick,
                        std::uint32_t owner, const Setpoint& setpoint)
      : sequence_(sequence), first_tick_(first_tick), expiry_tick_(expiry_tick), owner_(owner), setpoint_(setpoint) {}

  std::uint64_t sequence_ = 0;
  std::uint64_t first_tick_ = 0;
  std::uint64_t expiry_tick_ = 0;
  std::uint32_t owner_ = 0;
  Setpoint setpoint_{};

  static_assert(std::is_trivially_copyable_v<Setpoint>);
};

}  // namespace liana
