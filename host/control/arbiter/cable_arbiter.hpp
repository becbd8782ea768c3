// The arbiter of a cable arm: what every arm can be asked for, and besides it held variables, the shape, and an
// operator who steers tip and nodes by hand.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/control/arbiter/arbiter.hpp"
#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/catch_up.hpp"
#include "host/control/arbiter/dither_order.hpp"
#include "host/control/arbiter/refusal_wait.hpp"
#include "host/control/arbiter/shape_transition.hpp"
#include "host/control/arbiter/speed_zone.hpp"
#include "host/control/arbiter/taut_pace.hpp"
#include "host/control/arbiter/teleop_input.hpp"
#include "host/control/virtual_fixtures/ease.hpp"
#include "host/control/virtual_fixtures/guidance.hpp"

namespace liana::arbiter {

extern template class Arbiter<cable::CableArm>;

class CableArbiter final : public Arbiter<cable::CableArm> {
 public:
  using Base = Arbiter<cable::CableArm>;

  // In `zone` the tip is asked to go no faster than the zone says. `check` looks at the straight pieces of a path,
  // `guidance` has the fixtures that guide a hand.
  explicit CableArbiter(const cable::RobotParams& table, const SpeedZone& zone = {},
                        SearchResult taken = SearchResult::kInItsInterval, PathCheck<cable::CableArm> check = {},
                        const virtual_fixtures::Guidance& guidance = {});

  // Requests of the owner besides those of every arm; they throw RequestError (not_enabled, fault, busy, refused).
  // `now` is the newest tick of the arm. Held variables: bit i of mask holds theta i at held_rad[i]; mask 0 releases
  // all.
  void hold_theta(const cable::Outputs& now, std::uint32_t mask, const cable::ThetaVector& held_rad);
  // Null-space targets; unused entries have node = 0. The core goes downhill from where it stands; with `search` (arm
  // at rest) the goal IK looks for the best shape of all first, and the nodes are led there before the targets
  // themselves are given.
  void shape(const cable::Outputs& now, const cable::NodeTargets& nodes, const cable::KeepClearTargets& clear,
             bool search);
  // Vr handles are for free space and the hand controller for the slit: `vr` is refused where the tip is inside, unless
  // `use` says anywhere, and let go where it comes to. The mapping of the device in use changes only while nobody
  // steers by it.
  void use_device(const cable::Outputs& now, const DeviceUse& use);
  // An arm at rest is dithered (firmware_like/cable/arm/dither.hpp): refused where a tension would leave floor or
  // ceiling.
  void dither(const cable::Outputs& now, double share, double duration_s);
  // An arm at rest is told what it carries beside its tool from now on, and stays where it is; `check` looks at the
  // ways of an arm that carries it.
  void carry(const cable::Outputs& now, const cable::TipLoad& payload, PathCheck<cable::CableArm> check);
  const cable::TipLoad& carried() const { return payload_; }
  // Besides what device and robot allow: the tip is asked to go no faster than this, from the next setpoint on; planned
  // lines from the next one on.
  void cap_tip_speed(double speed_m_s);
  // Which fixtures act on the hand from the next interval on.
  void choose_fixtures(const virtual_fixtures::Choice& names) { guidance_.choose(names); }
  // Once per interval, before next_setpoint: what is known of scene and tip beside drawing and command.
  void see(const virtual_fixtures::Sight& sight) { guidance_.see(sight, interval_s_); }
  // As every arm's; nobody steers any more until use_device is asked for.
  void retract(const cable::Outputs& now, std::uint64_t until_tick) override;
  // The operator has to let go and engage again, too.
  void hold(const std::string& why = "held") override;
  std::optional<cable::Setpoint> next_setpoint(std::uint64_t tick, const cable::Outputs& now) override;
  // The arm waits for an operator who steers it (refusal_wait.hpp).
  bool refused(const std::string& why = "", bool may_pass_slower = false) override;
  bool leads_hand() const override { return was_engaged_; }
  bool stands_refused() const override { return was_engaged_ && refusal_wait_.stands(); }
  // Half, a seventh, and to stay.
  std::optional<cable::Setpoint> slower(const cable::Outputs& now, const char* limit) override;

  // A planned move or a dither is under way.
  bool is_busy() const override { return Base::is_busy() || dither_.is_under_way(); }
  // A shape is looked for (the arm holds meanwhile), or the nodes are on their way to the one that was found; their own
  // targets come after it.
  bool is_searching() const { return lead_.is_under_way(); }
  // What the shape was last asked for.
  const cable::NodeTargets& nodes() const { return nodes_; }
  const cable::KeepClearTargets& keep_clear() const { return wishes().clear; }
  std::uint32_t held_mask() const { return wishes().held_mask; }
  const virtual_fixtures::Guidance& guidance() const { return guidance_; }
  // Why the hand is followed more slowly than it asks, and how much; nothing while nobody steers.
  virtual_fixtures::Ease ease() const;
  TeleopInput& device() { return device_; }
  const TeleopInput& device() const { return device_; }

 private:
  void require_free(const cable::Outputs& now) const override;
  std::optional<cable::Setpoint> wished_setpoint(std::uint64_t tick, const cable::Outputs& now);
  void ask_objectives_anew(const cable::Outputs& now);
  void take_device_away();
  void require_open_clutch(const DeviceUse& use) const;
  bool is_vr_in_slit(const cable::Outputs& now, const DeviceUse& use) const;
  void set_node_objectives();
  cable::Setpoint dithering_setpoint();
  std::optional<cable::Setpoint> steered_setpoint(const cable::Outputs& now, const TeleopGoal& goal);
  cable::Setpoint led_setpoint(const cable::Outputs& now);
  void end_shape_transition();
  void ask_speed();
  Vec3 tip_of(const cable::ThetaVector& theta_rad) const;
  double speed_left_m_s(const Vec3& way_m, double limit_m_s) override;
  double pace_left(const cable::Outputs& now) override;

  double asked_speed_m_s_;  // limit of the device in use, or of the robot's tip
  double robot_speed_m_s_;
  double cap_m_s_;
  double interval_s_;
  ShapeTransition lead_;
  cable::NodeTargets nodes_{};
  DitherOrder dither_;
  cable::ThetaVector dithered_at_rad_{};
  cable::TipLoad payload_{};  // in every setpoint
  TeleopInput device_;
  cable::NodeTarget device_node_{};
  bool was_engaged_ = false;
  RefusalWait refusal_wait_;
  CatchUp catch_up_;
  TautPace taut_pace_;
  double lag_share_ = 1.0;       // of the tip's speed, what an arm that lags leaves
  Pose led_from_{}, led_to_{};   // last setpoint of the hand: where the tip was commanded to be, and its goal
  std::size_t slower_ways_ = 0;  // that were tried in its interval
  double asked_share_ = 1.0;     // of its first setpoint
  double keeps_shape_s_ = 0.0;   // how much longer only the last segments follow the hand
  virtual_fixtures::Guidance guidance_;
  virtual_fixtures::Ease ease_;
};

}  // namespace liana::arbiter
