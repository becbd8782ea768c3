#include "host/arbiter/arbiter.hpp"

#include <algorithm>
#include <string>

#include "firmware_like/safety/faults.hpp"
#include "host/api/request_error.hpp"
#include "host/solve/goal_ik.hpp"

namespace liana {

namespace {

// A tip goal counts as reached within these, some intervals after it was set: a request needs two to show in the arm's
// report.
constexpr double kArrived_m = 1e-5;
constexpr double kArrived_rad = 1e-5;
constexpr std::int32_t kSettledIntervals = 10;
constexpr double kLed_m = 0.005;            // nodes nearer than this to the shape that was found are there
constexpr std::int32_t kRestIntervals = 3;  // a command released before the stop may still be on its way

}  // namespace

bool has_nodes(const NodeTargets& nodes) {
  for (const NodeTarget& target : nodes) {
    if (target.node != 0) return true;
  }
  return false;
}

Arbiter::Arbiter(const RobotTable& table, const SpeedZone& zone, SearchResult taken)
    : table_(table),
      zone_(zone),
      interval_s_(table.tick_s * table.interval_ticks),
      taken_(taken),
      search_(table),
      tip_speed_m_s_(table.limits.tip_speed_m_s) {}

void Arbiter::require_ready(const cable::Outputs& now) const {
  if (now.faults.count > 0) {
    throw RequestError(
        "fault", std::string("fault ") + fault_info(now.faults.fault[0].number).name + " is latched: clear it first");
  }
  if (now.state != OperatingState::kEnabled) throw RequestError("not_enabled", "the arm is not enabled");
}

void Arbiter::require_free(const cable::Outputs& now) const {
  require_ready(now);
  if (is_searching())
    throw RequestError("busy", "the shape that a search has found is gone to: wait until it has settled or send hold");
  if (is_busy()) throw RequestError("busy", "a planned move is under way: wait for it or send hold");
  if (device_.engaged()) throw RequestError("busy", "the operator steers: wait for the deadman to open");
}

// The tip stays where the command stands now.
void Arbiter::stay_here(const cable::Outputs& now) {
  tip_goal_ = now.tip_command;
  mode_ = Mode::kTip;
  unchanged_intervals_ = 0;
}

void Arbiter::move_joints(const cable::Outputs& now, const ThetaVector& goal_rad, double rate_rad_s) {
  require_free(now);
  joint_move_.emplace(table_, now.theta_command_rad, goal_rad, rate_rad_s);
  move_time_s_ = 0.0;
  mode_ = Mode::kJoint;
}

void Arbiter::move_line(const cable::Outputs& now, const Pose& goal) {
  require_free(now);
  line_.emplace(table_, mode_ == Mode::kTip ? tip_goal_ : now.tip_command, goal, tip_speed_m_s_);
  move_time_s_ = 0.0;
  mode_ = Mode::kLine;
}

void Arbiter::servo_tip(const cable::Outputs& now, const Pose& goal) {
  require_free(now);
  tip_goal_ = goal;
  mode_ = Mode::kTip;
  unchanged_intervals_ = 0;
}

void Arbiter::hold_theta(const cable::Outputs& now, std::uint32_t mask, const ThetaVector& held_rad) {
  require_ready(now);
  held_mask_ = mask;
  held_rad_ = held_rad;
  unchanged_intervals_ = 0;
  if (mode_ == Mode::kIdle && !device_.engaged()) stay_here(now);
}

void Arbiter::shape(const cable::Outputs& now, const NodeTargets& nodes, const KeepClearTargets& clear, bool search) {
  require_ready(now);
  if (search && is_busy())
    throw RequestError("busy", "search needs an arm at rest, a planned move is under way: wait for it or send hold");
  if (search && now.at_rest == 0)
    throw RequestError("busy", "search looks for a shape of the arm at rest: wait for it or send hold");
  search_.forget();
  if (search) search_.start({now.tip_command, now.theta_command_rad, held_mask_, held_rad_, nodes, clear});
  nodes_ = nodes;
  clear_ = clear;
  lead_ = NodeTargets{};
  unchanged_intervals_ = 0;
  if (mode_ == Mode::kIdle && !device_.engaged()) stay_here(now);
}

// The arm holds until the result of a search is there.
bool Arbiter::awaits_search() {
  if (!search_.is_wanted()) return false;
  const std::optional<solve::GoalIkResult> best = search_.take(taken_ == SearchResult::kInItsInterval);
  if (!best) return true;
  lead_ = nodes_of(*best);
  unchanged_intervals_ = 0;
  return false;
}

// Nodes of the shape that was found; none when no solution was.
NodeTargets Arbiter::nodes_of(const solve::GoalIkResult& best) const {
  NodeTargets out{};
  if (!best.converged) return out;
  const ArmKinematics arm = forward_kinematics(table_, best.theta_rad);
  const std::int32_t count = std::min(table_.segment_count - 1, kMaxNodeTargets);
  for (std::int32_t node = 1; node <= count; ++node)
    out[static_cast<std::size_t>(node - 1)] = {node, arm.node_in_base[static_cast<std::size_t>(node)].position_m, 1.0,
                                               0.0};
  return out;
}

// The lead is over when the nodes are there, or come no nearer.
void Arbiter::end_lead(const cable::Outputs& now) {
  bool there = true;
  for (const NodeTarget& target : lead_) {
    if (target.node == 0) continue;
    there = there &&
            norm(subtract(target.position_m, now.node_command_m[static_cast<std::size_t>(target.node - 1)])) < kLed_m;
  }
  if (!there && (unchanged_intervals_ < kSettledIntervals || now.at_rest == 0)) return;
  lead_ = NodeTargets{};
  unchanged_intervals_ = 0;
}

void Arbiter::use_device(const DeviceUse& use) {
  if (is_busy()) throw RequestError("busy", "a planned move is under way: wait for it or send hold");
  take_device_away();
  device_.use(use);
  tip_speed_m_s_ = use.speed_m_s > 0.0 ? use.speed_m_s : table_.limits.tip_speed_m_s;
}

void Arbiter::take_device_away() {
  device_.use(DeviceUse{});
  device_node_ = NodeTarget{};
  was_engaged_ = false;
}

// The way out takes over from whatever is under way. An operator who could grip again would steer back in as soon as it
// ends.
void Arbiter::retract(const cable::Outputs& now, std::uint64_t until_tick) {
  require_ready(now);
  if (path_.empty()) throw RequestError("refused", "there is no stored path to go back along");
  search_.forget();
  take_device_away();
  way_back_.emplace(until_tick);
  rest_intervals_ = 0;
  has_retracted_ = false;
  mode_ = Mode::kRetract;
}

void Arbiter::hold() {
  mode_ = Mode::kIdle;
  search_.forget();
  lead_ = NodeTargets{};
  device_.let_go();
}

void Arbiter::refused() {
  rest_intervals_ = 0;
  if (mode_ != Mode::kRetract || !way_back_->start_again()) mode_ = Mode::kIdle;
  device_.drop_anchor();
}

Setpoint Arbiter::tip_setpoint(const cable::Outputs& now) const {
  Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  setpoint.tip_in_base = tip_goal_;
  setpoint.held_mask = held_mask_;
  setpoint.held_rad = held_rad_;
  setpoint.node = is_searching() ? lead_ : nodes_;
  setpoint.clear = clear_;
  setpoint.tip_speed_m_s =
      zone_.advice_at(now.tip_command.position_m, zone_.advice_at(tip_goal_.position_m, tip_speed_m_s_));
  if (device_node_.node == 0) return setpoint;
  for (NodeTarget& slot : setpoint.node) {
    if (slot.node != 0 && slot.node != device_node_.node) continue;
    slot = device_node_;
    break;
  }
  return setpoint;
}

Setpoint Arbiter::joint_setpoint(const ThetaVector& theta_rad) const {
  Setpoint setpoint;
  setpoint.kind = CommandKind::kJoint;
  setpoint.joint_rad = theta_rad;
  setpoint.tip_speed_m_s = table_.limits.tip_speed_m_s;
  return setpoint;
}

std::optional<Setpoint> Arbiter::next_setpoint(std::uint64_t tick, const cable::Outputs& now) {
  const std::optional<SteerGoal> steer = device_.finish_interval(now, interval_s_);
  if (now.state != OperatingState::kEnabled) {
    hold();
    path_.clear();
    held_mask_ = 0;
    nodes_ = {};
    clear_ = {};
    return std::nullopt;
  }
  const bool going_back = mode_ == Mode::kRetract && rest_intervals_ >= kRestIntervals;
  if (!going_back) path_.note(tick, now.theta_command_rad);  // the stop before the way back is part of the way in
  if (is_busy()) {
    device_.drop_anchor();  // a hand that closes the deadman now starts from where the move ends
    return planned_setpoint(now);
  }
  const bool awaits = awaits_search();
  if (steer) return steered_setpoint(now, *steer);
  if (was_engaged_) mode_ = Mode::kIdle;  // the operator let go: stop along the path
  was_engaged_ = false;
  if (awaits) return std::nullopt;
  if (is_searching()) end_lead(now);
  if (mode_ == Mode::kTip && has_arrived(now)) mode_ = Mode::kIdle;
  ++unchanged_intervals_;
  return mode_ == Mode::kTip ? std::optional(tip_setpoint(now)) : std::nullopt;
}

// Tip and held variables stand where they should; nothing more is asked for, and the null space comes to rest. Node
// targets are in force until they stand, too.
bool Arbiter::has_arrived(const cable::Outputs& now) const {
  if (unchanged_intervals_ < kSettledIntervals || now.held_at_target == 0) return false;
  const bool shape_wanted = has_nodes(tip_setpoint(now).node) || largest_weight(clear_) > 0.0;
  if (shape_wanted) return now.at_rest != 0;
  const Vec3 turn = rotation_vector(multiply(tip_goal_.quaternion, conjugate(now.tip_command.quaternion)));
  return norm(subtract(tip_goal_.position_m, now.tip_command.position_m)) < kArrived_m && norm(turn) < kArrived_rad;
}

std::optional<Setpoint> Arbiter::steered_setpoint(const cable::Outputs& now, const SteerGoal& goal) {
  was_engaged_ = true;
  unchanged_intervals_ = 0;
  mode_ = Mode::kTip;
  tip_goal_ = goal.tip_in_base;
  device_node_ = goal.node;
  return tip_setpoint(now);
}

std::optional<Setpoint> Arbiter::planned_setpoint(const cable::Outputs& now) {
  move_time_s_ += interval_s_;
  if (mode_ == Mode::kLine) {
    tip_goal_ = line_->at(move_time_s_);
    if (move_time_s_ >= line_->duration_s()) mode_ = Mode::kTip;
    unchanged_intervals_ = 0;
    return tip_setpoint(now);
  }
  if (mode_ == Mode::kJoint) {
    const bool arrived = move_time_s_ >= joint_move_->duration_s();
    if (arrived && now.at_rest != 0) mode_ = Mode::kIdle;
    return joint_setpoint(joint_move_->at(move_time_s_));
  }
  return way_back_setpoint(now);
}

// Nothing is asked for until the arm has come to rest; then the way back begins where it stands.
std::optional<Setpoint> Arbiter::way_back_setpoint(const cable::Outputs& now) {
  if (rest_intervals_ < kRestIntervals) {
    rest_intervals_ = now.at_rest != 0 ? rest_intervals_ + 1 : 0;
    return std::nullopt;
  }
  const std::optional<ThetaVector> back = way_back_->next(path_);
  if (back) return joint_setpoint(*back);
  has_retracted_ = true;
  mode_ = Mode::kIdle;
  return std::nullopt;
}

}  // namespace liana
