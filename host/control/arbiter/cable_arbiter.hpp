// The arbiter of a cable arm: what every arm can be asked for, and besides it held variables, the shape, and an
// operator who steers tip and nodes by hand.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/control/arbiter/arbiter.hpp"
#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/dither_order.hpp"
#include "host/control/arbiter/refusal_wait.hpp"
#include "host/control/arbiter/shape_transition.hpp"
#include "host/control/arbiter/speed_zone.hpp"
#include "host/control/arbiter/teleop_input.hpp"
#include "host/control/virtual_fixtures/ease.hpp"
#include "host/control/virtual_fixtures/guidance.hpp"

namespace liana::arbiter {

extern template class Arbiter<cable::CableArm>;

class CableArbiter {
 public:
  // In `zone` the tip is asked to go no faster than the zone says. `check` looks at the straight pieces of a path,
  // `guidance` has the fixtures that guide a hand.
  explicit CableArbiter(const cable::RobotParams& table, const SpeedZone& zone = {},
                        SearchResult taken = SearchResult::kInItsInterval, PathCheck<cable::CableArm> check = {},
                        const virtual_fixtures::Guidance& guidance = {});

  // Requests of the owner; they throw RequestError (not_enabled, fault, busy, refused). `now` is the newest tick of the
  // arm.
  void move_joints(const cable::Outputs& now, const cable::ThetaVector& goal_rad, double rate_rad_s,
                   const motion::Swings& swings = {});
  void move_line(const cable::Outputs& now, const Pose& goal, const motion::Swings& swings = {});
  void servo_tip(const cable::Outputs& now, const Pose& goal);
  void move_path(const cable::Outputs& now, const PathRequest<cable::CableArm>& request);
  void servo_target(const cable::Outputs& now, const visual_servo::ServoRequest& request);
  void see_target(const std::string& target, double capture_s, const Pose& target_in_tip) {
    moves_.see_target(target, capture_s, target_in_tip);
  }
  // The servo under way, or how the last one went.
  const visual_servo::ServoStatus& servo_report() const { return moves_.servo_report(); }
  // Held variables: bit i of mask holds theta i at held_rad[i]; mask 0 releases all.
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
  // Besides what device and robot allow: the tip is asked to go no faster than this, from the next setpoint on; planned
  // lines from the next one on.
  void cap_tip_speed(double speed_m_s);
  // Which fixtures act on the hand from the next interval on.
  void choose_fixtures(const virtual_fixtures::Choice& names) { guidance_.choose(names); }
  // Once per interval, before next_setpoint: what is known of scene and tip beside drawing and command.
  void see(const virtual_fixtures::Sight& sight) { guidance_.see(sight, interval_s_); }
  // Back along the verified path, not beyond `until_tick`: stops, then goes back. Nobody steers any more until
  // use_device is asked for.
  void retract(const cable::Outputs& now, std::uint64_t until_tick);
  // Stop along the path: nothing is asked for any more. The operator has to let go and engage again.
  void hold();

  // Ends the interval: what to verify for the next one; nothing = the arm holds. `tick` counts the ticks done.
  std::optional<cable::Setpoint> next_setpoint(std::uint64_t tick, const cable::Outputs& now);
  // The setpoint was refused: planned moves end, and the arm waits for an operator who steers it (refusal_wait.hpp).
  // The way back stops and starts again, some times, and where `may_pass_slower` moves to a goal do (another_try.hpp).
  // Whether what was asked for goes on.
  bool refused(const std::string& why = "", bool may_pass_slower = false);
  // Whether the last setpoint was a hand's; and whether one was refused for the same limit a moment ago.
  bool leads_hand() const { return was_engaged_; }
  bool stands_refused() const { return was_engaged_ && refusal_wait_.stands(); }
  // What a hand asks for, with less of its speed than in the setpoint that was refused for `limit` (its name in the
  // table of refusals), for the same interval: half, a seventh, and to stay. Then nothing, and where nobody steers.
  std::optional<cable::Setpoint> slower(const cable::Outputs& now, const char* limit);

  // A planned move or a dither is under way.
  bool is_busy() const { return moves_.is_busy() || dither_.is_under_way(); }
  // A tip goal, or what is asked for besides, has not come to be yet.
  bool is_asking() const { return moves_.is_asking(); }
  bool is_going_back() const { return moves_.is_going_back(); }
  // The retract under way, or how the last one went.
  RetractState retract_state() const { return moves_.retract_state(); }
  bool has_retracted() const { return moves_.has_retracted(); }
  // The verified way back, for a copy that survives lianad.
  PathHistory<cable::ThetaVector>& path_history() { return moves_.path_history(); }
  std::vector<RetractEvents> take_way_news() { return moves_.take_way_news(); }
  // The path under way, and what has become of paths since the last call.
  std::optional<PathProgress> path() const { return moves_.path(); }
  std::vector<PathEvents> take_path_news() { return moves_.take_path_news(); }
  // A shape is looked for (the arm holds meanwhile), or the nodes are on their way to the one that was found; their own
  // targets come after it.
  bool is_searching() const { return lead_.is_under_way(); }
  // What the shape was last asked for.
  const cable::NodeTargets& nodes() const { return nodes_; }
  const cable::KeepClearTargets& keep_clear() const { return moves_.wishes().clear; }
  std::uint32_t held_mask() const { return moves_.wishes().held_mask; }
  const virtual_fixtures::Guidance& guidance() const { return guidance_; }
  // Why the hand is followed more slowly than it asks, and how much; nothing while nobody steers.
  const virtual_fixtures::Ease& ease() const { return ease_; }
  TeleopInput& device() { return device_; }
  const TeleopInput& device() const { return device_; }

 private:
  void require_free(const cable::Outputs& now) const;
  void ask_anew(const cable::Outputs& now);
  void take_device_away();
  void require_open_clutch(const DeviceUse& use) const;
  bool is_vr_in_slit(const cable::Outputs& now, const DeviceUse& use) const;
  void set_node_objectives();
  cable::Setpoint dithering_setpoint();
  std::optional<cable::Setpoint> steered_setpoint(const cable::Outputs& now, const TeleopGoal& goal);
  cable::Setpoint led_setpoint(const cable::Outputs& now);
  void end_shape_transition();
  void ask_speed();

  cable::RobotParams table_;
  double asked_speed_m_s_;  // limit of the device in use, or of the robot's tip
  double robot_speed_m_s_;
  double cap_m_s_;
  SpeedZone zone_;
  double interval_s_;
  Arbiter<cable::CableArm> moves_;
  ShapeTransition lead_;
  cable::NodeTargets nodes_{};
  DitherOrder dither_;
  cable::ThetaVector dithered_at_rad_{};
  TeleopInput device_;
  cable::NodeTarget device_node_{};
  bool was_engaged_ = false;
  RefusalWait refusal_wait_;
  Pose led_from_{}, led_to_{};   // last setpoint of the hand: where the tip was commanded to be, and its goal
  std::size_t slower_ways_ = 0;  // that were tried in its interval
  double asked_share_ = 1.0;     // of its first setpoint
  virtual_fixtures::Guidance guidance_;
  virtual_fixtures::Ease ease_;
};

}  // namespace liana::arbiter
