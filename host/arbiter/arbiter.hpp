// One wish per command interval: the arbiter turns the owner's requests and the operator's hand into the setpoint to
// verify next.
#pragma once

#include <cstdint>
#include <optional>

#include "host/arbiter/device_steer.hpp"
#include "host/arbiter/goal_search.hpp"
#include "host/arbiter/moves.hpp"
#include "host/arbiter/speed_zone.hpp"

namespace liana {

using namespace cable;  // this room serves the cable arm only

// Whether any entry is used.
bool has_nodes(const NodeTargets& nodes);

// When the result of a search for a shape is taken: in virtual time at the end of the interval that asked for it, so
// that runs repeat bit for bit; in real time in the first interval that finds it there.
enum class SearchResult { kInItsInterval, kWhenThere };

class Arbiter {
 public:
  // In `zone` the tip is asked to go no faster than the zone says.
  explicit Arbiter(const RobotTable& table, const SpeedZone& zone = {},
                   SearchResult taken = SearchResult::kInItsInterval);

  // Requests of the owner; they throw RequestError (not_enabled, fault, busy, refused). `now` is the newest tick of the
  // arm.
  void move_joints(const cable::Outputs& now, const ThetaVector& goal_rad, double rate_rad_s);
  void move_line(const cable::Outputs& now, const Pose& goal);
  void servo_tip(const cable::Outputs& now, const Pose& goal);
  // Held variables: bit i of mask holds theta i at held_rad[i]; mask 0 releases all.
  void hold_theta(const cable::Outputs& now, std::uint32_t mask, const ThetaVector& held_rad);
  // Null-space targets; unused entries have node = 0. The core goes downhill from where it stands; with `search` (arm
  // at rest) the goal IK looks for the best shape of all first, and the nodes are led there before the targets
  // themselves are given.
  void shape(const cable::Outputs& now, const NodeTargets& nodes, const KeepClearTargets& clear, bool search);
  void use_device(const DeviceUse& use);
  // Back along the verified path, not beyond `until_tick`: stops, then goes back. Nobody steers any more until
  // use_device is asked for.
  void retract(const cable::Outputs& now, std::uint64_t until_tick);
  // Stop along the path: nothing is asked for any more. The operator has to let go and engage again.
  void hold();

  // Ends the interval: what to verify for the next one; nothing = the arm holds. `tick` counts the ticks done.
  std::optional<Setpoint> next_setpoint(std::uint64_t tick, const cable::Outputs& now);
  // The setpoint was refused: planned moves end, the operator's clutch takes new anchors. The way back stops and starts
  // again, some times.
  void refused();

  // A planned move is under way.
  bool is_busy() const { return mode_ == Mode::kLine || mode_ == Mode::kJoint || mode_ == Mode::kRetract; }
  // The last retract has gone back all the way.
  bool has_retracted() const { return has_retracted_; }
  // A shape is looked for (the arm holds meanwhile), or the nodes are on their way to the one that was found; their own
  // targets come after it.
  bool is_searching() const { return search_.is_wanted() || has_nodes(lead_); }
  // What the shape was last asked for.
  const NodeTargets& nodes() const { return nodes_; }
  const KeepClearTargets& keep_clear() const { return clear_; }
  std::uint32_t held_mask() const { return held_mask_; }
  DeviceSteer& device() { return device_; }
  const DeviceSteer& device() const { return device_; }

 private:
  enum class Mode { kIdle, kTip, kLine, kJoint, kRetract };

  void require_ready(const cable::Outputs& now) const;
  void require_free(const cable::Outputs& now) const;
  void stay_here(const cable::Outputs& now);
  void take_device_away();
  Setpoint tip_setpoint(const cable::Outputs& now) const;
  Setpoint joint_setpoint(const ThetaVector& theta_rad) const;
  bool has_arrived(const cable::Outputs& now) const;
  bool awaits_search();
  NodeTargets nodes_of(const solve::GoalIkResult& best) const;
  void end_lead(const cable::Outputs& now);
  std::optional<Setpoint> planned_setpoint(const cable::Outputs& now);
  std::optional<Setpoint> way_back_setpoint(const cable::Outputs& now);
  std::optional<Setpoint> steered_setpoint(const cable::Outputs& now, const SteerGoal& goal);

  RobotTable table_;
  SpeedZone zone_;
  double interval_s_;
  Mode mode_ = Mode::kIdle;
  double move_time_s_ = 0.0;
  std::int32_t unchanged_intervals_ = 0;  // since the tip goal, held variables or nodes were set
  std::optional<JointMove> joint_move_;
  std::optional<TipLine> line_;
  std::optional<WayBack> way_back_;
  std::int32_t rest_intervals_ = 0;  // in a row at rest before the way back starts
  bool has_retracted_ = false;
  Pose tip_goal_{};
  std::uint32_t held_mask_ = 0;
  ThetaVector held_rad_{};
  NodeTargets nodes_{};
  KeepClearTargets clear_{};
  SearchResult taken_;
  GoalSearch search_;
  NodeTargets lead_{};  // to the shape that a search has found; unused: the targets themselves are in force
  NodeTarget device_node_{};
  double tip_speed_m_s_;
  bool was_engaged_ = false;
  PathMemory path_;
  DeviceSteer device_;
};

}  // namespace liana
