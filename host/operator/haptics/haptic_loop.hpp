// The hand's side of force feedback, one millisecond a step: what a process beside a device runs, and the only door to
// this room for it. Packets, predictions and planes come when they come; `step` never waits for them.
//
//   law  ->  fade out of what is old  ->  rate limit  ->  + wall and damping  ->  clamp  ->  energy tank  ->  motors
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "host/api/device/sample.hpp"
#include "host/control/virtual_fixtures/moving_plane.hpp"
#include "host/operator/haptics/energy_tank.hpp"
#include "host/operator/haptics/feedback_law.hpp"
#include "host/operator/haptics/packets.hpp"
#include "host/operator/haptics/prediction_track.hpp"

namespace liana::haptics {

struct HandLoopTable {
  Law law = Law::kAligned;
  LawGains gains{};
  TankParams tank{};
  double force_N = 12.0;       // what the device can
  double law_N_s = 200.0;      // rate limit of what comes from the arm: 12 N in 60 ms, a hand at 1 m/s against K 200
  double damping_N_s_m = 3.0;  // of every motion: a hand that has let go comes to rest; 0.3 N at 0.1 m/s; 0 .. 20
  double fresh_s = 0.3;        // a state this old is still felt in full; more than jitter of 20 % of 2 s leaves out
  double fade_s = 0.2;         // after that it fades, to 1 / e in this time
  double velocity_s = 0.005;   // low pass of the hand's velocity
};

// What a step gave, for logs and pictures.
struct HandForce {
  Vec3 force_N{};  // for the motors
  Vec3 law_N{};    // of it, before clamp and tank: from the arm
  Vec3 wall_N{};   // and from the wall
  double store_J = 0.0;
  double passed = 1.0;  // part that the tank let through
  double fresh = 0.0;   // 0: nothing of the arm is felt (nothing heard, too old, not engaged) .. 1
  bool clamped = false;
};

constexpr std::size_t kMaxWalls = 6;

// Deterministic: the same calls give the same forces. No heap, no clock.
class HapticLoop {
 public:
  // Throws std::invalid_argument that names the field, its value and the range.
  explicit HapticLoop(const HandLoopTable& table);

  // The arm's state has arrived; false and no effect when a newer one has been here.
  bool take(const StatePacket& packet) noexcept;
  // Where the arm is predicted to be at `t_us` of the hand's clock: had every command acted when it was sent.
  void predict(std::int64_t t_us, const Motion& tip) noexcept { predictions_.put(t_us, tip); }
  // A wall in one of kMaxWalls slots, every 20 ms; false and no effect when it is not valid, or there is no such slot.
  bool take(const Plane& plane, std::size_t slot = 0) noexcept { return slot < kMaxWalls && walls_[slot].take(plane); }
  // Another law, from the next step on; the rate limit makes the switch smooth.
  void choose(Law law) noexcept { table_.law = law; }
  // Another mapping: the tip's way for one of the hand, over 0. From the next step on; smooth, too.
  void scale_by(double scale) noexcept { table_.gains.scale = scale; }

  // One millisecond after the last: the device's sample, and where the hand asks the tip to be with it (after clutch
  // and scale). A sample that is not valid gives no force.
  const HandForce& step(const device::Sample& sample, const Vec3& commanded_m) noexcept;

  // States that came too late or twice.
  std::int64_t dropped() const { return newest_.dropped(); }

 private:
  struct Heard {
    Motion tip{};
    Motion predicted_then{};
    std::int64_t since_us = 0;
  };
  void feel_hand(const Vec3& position_m) noexcept;
  Vec3 force_of_walls() noexcept;
  double freshness(bool engaged) const noexcept;
  Vec3 wanted_of_arm(const Vec3& commanded_m) const noexcept;

  HandLoopTable table_;
  Newest newest_;
  PredictionTrack predictions_;
  std::array<MovingPlane, kMaxWalls> walls_{};
  EnergyTank tank_;
  std::optional<Heard> heard_;
  Motion hand_{};
  bool begun_ = false;
  HandForce out_{};
};

}  // namespace liana::haptics
