// Hand, device, link and an arm that touches a wall, in one loop: what properties and `./dev numbers stability` run.
// The arm is that of docs/explanation/force-feedback.md: the shipped operator filter, then a tip of 0.4 kg on 40 N/m.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/operator_input/tip_filter.hpp"
#include "host/operator/haptics/haptic_loop.hpp"
#include "host/operator/haptics/link.hpp"
#include "host/operator/haptics/omega.hpp"

namespace liana::haptics::rig {

// The tip of a soft arm, along y only a wall is met.
class SoftArm {
 public:
  // `wall_m`: free below it; `wall_N_m` 0: no wall.
  SoftArm(const Vec3& start_m, double wall_m, double wall_N_m);
  // One millisecond towards a commanded position.
  void step(const Vec3& command_m);
  const Motion& tip() const { return tip_; }

 private:
  ChannelState filter_{};
  Vec3 filtered_m_;
  Motion tip_;
  double wall_m_;
  double wall_N_m_;
};

struct RigTable {
  HandLoopTable loop{};
  HandParams hand{};
  LinkTable link{};  // of either direction
  double wall_N_m = 0.0;
  std::uint64_t seed = 1;
};

// The reach of the map: 0.10 m in 4 s through a wall at its half, held for 3 s, and back.
constexpr double kReachEnd_s = 11.0;
Intent reach_intent(double t_s);

class BilateralRig {
 public:
  explicit BilateralRig(const RigTable& table);

  // One millisecond.
  void step(const Intent& intent);
  HapticLoop& loop() { return loop_; }
  // Either direction of the link from now on.
  void change_link(const LinkTable& table);

  const HeldOmega& omega() const { return omega_; }
  const HandForce& force() const { return force_; }
  const Motion& tip() const { return arm_.tip(); }
  double now_s() const { return 1e-6 * static_cast<double>(now_us_); }

 private:
  void exchange(const Vec3& hand_m);
  void advance_arm();

  HeldOmega omega_;
  HapticLoop loop_;
  Link<CommandPacket> forward_;
  Link<StatePacket> back_;
  SoftArm arm_;
  SoftArm predicted_;
  Newest newest_command_;
  CommandPacket applied_{};
  std::int64_t applied_since_us_ = -1;
  Vec3 sent_m_;
  std::uint32_t sequence_ = 0;
  std::int64_t now_us_ = 0;
  HandForce force_{};
};

}  // namespace liana::haptics::rig
