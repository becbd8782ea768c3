#include "firmware_like/cable/shape/shape.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

constexpr std::int32_t kBoundPasses = 1;  // changes of the active set in a tick; the next one goes on from there
constexpr double kLastMoment_s = 0.1;     // room to a limit over this bounds the smoothed rate

bool is_node(const RobotParams& table, const NodeTarget& target) noexcept {
  return target.node >= 1 && target.node <= table.segment_count;
}

Vec3 towards_target(const ArmKinematics& arm, const NodeTarget& target) noexcept {
  return subtract(target.position_m, arm.node_in_base[static_cast<Index>(target.node)].position_m);
}

// Pitch of the segment before the planar part at the arm's end; theta_count when there is no planar part.
Index lead_pitch(const RobotParams& table, std::uint32_t held_mask) noexcept {
  std::int32_t m = table.segment_count - 1;
  while (m >= 0 && ((held_mask >> (2 * m)) & 1u) != 0) --m;
  const bool planar = m < table.segment_count - 1 && m >= 0;
  return static_cast<Index>(planar ? 2 * m : table.theta_count());
}

// Change of theta that centring asks for within `time_s`.
ThetaVector centring(const RobotParams& table, std::uint32_t held_mask, double time_s,
                     const ThetaVector& theta) noexcept {
  const Index lead = lead_pitch(table, held_mask);
  ThetaVector pull{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) pull[k] = -kCentringRate_1_s * time_s * theta[k];
  if (lead < static_cast<Index>(table.theta_count())) pull[lead] *= kLeadWeight;
  return pull;
}

// Weight of centring beside the largest weight of what else is wanted; its size does not matter when there is nothing.
double centring_weight(double largest) noexcept { return largest > 0.0 ? kCentringShare * largest : 1.0; }

double largest_entry(const ThetaVector& v, Index n) noexcept {
  double largest = 0.0;
  for (Index k = 0; k < n; ++k) largest = larger(largest, std::fabs(v[k]));
  return largest;
}

// Least room of any theta to its limit; negative when one is beyond it.
double min_room_rad(const RobotParams& table, const ThetaVector& theta) noexcept {
  double least = 1e300;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    least =
        smaller(least, table.segment[m].theta_limit_rad - larger(std::fabs(theta[2 * m]), std::fabs(theta[2 * m + 1])));
  }
  return least;
}

// Where the arm stands, for all steps of a tick.
struct Stand {
  const RobotParams& table;
  const ThetaVector& theta_rad;
  const NullSpace& space;
  double min_room_rad;
};

// True when a rate with this largest entry may pass a limit within `time_s`.
bool may_pass_limit(const Stand& stand, double time_s, double largest) noexcept {
  return largest * time_s > stand.min_room_rad;
}

// A node within its threshold wants nothing; one outside wants to come back within.
void add_node(const ArmKinematics& arm, const NodeTarget& target, PullSum& sum) noexcept {
  const Vec3 towards = towards_target(arm, target);
  const double distance = std::sqrt(dot(towards, towards));
  if (!(distance > target.threshold_m) || distance < 1e-9) return;
  Pull pull;
  pull.weight = target.weight;
  pull.excess_m = distance - target.threshold_m;
  pull.distance_m = distance;
  pull.towards = scale(towards, 1.0 / distance);
  pull.columns = 2 * target.node;
  const Vec3 lever = subtract(arm.node_in_base[static_cast<Index>(target.node)].position_m, arm.tip_in_base.position_m);
  for (Index k = 0; k < static_cast<Index>(pull.columns); ++k)
    pull.column[k] = add(arm.tip_jacobian.linear[k], cross(arm.tip_jacobian.angular[k], lever));
  add_pull(pull, sum);
}

// Adds pull `index` of a round: nodes first, then every segment away from every target. False when there is no such
// pull.
bool add_pull_of_round(const RobotParams& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                       const NodeTargets& nodes, const KeepClearTargets& clear, Index index, PullSum& sum) noexcept {
  if (index < nodes.size()) {
    if (!is_node(table, nodes[index]) || !(nodes[index].weight > 0.0)) return false;
    add_node(arm, nodes[index], sum);
    return true;
  }
  const Index segments = static_cast<Index>(table.segment_count), pair = index - nodes.size(), m = pair % segments;
  const KeepClear& target = clear[pair / segments];
  if (!is_used(target)) return false;
  add_clearance(table, arm_trig(table, theta_rad)[m], arm, target, static_cast<std::int32_t>(m), sum);
  return true;
}

// Takes one more pull of the round; false when the round is complete. Other weights begin a new one.
bool gather(const RobotParams& table, const ThetaVector& theta_rad, const ArmKinematics& arm, const NodeTargets& nodes,
            const KeepClearTargets& clear, double weight, ShapeState& state) noexcept {
  if (weight != state.weight) state.next_pull = 0;
  state.weight = weight;
  if (!(weight > 0.0)) return false;
  if (state.next_pull == 0) reset_pulls(table.theta_count(), state.pulls);
  const Index pulls = nodes.size() + clear.size() * static_cast<Index>(table.segment_count);
  while (state.next_pull < pulls) {
    if (add_pull_of_round(table, theta_rad, arm, nodes, clear, static_cast<Index>(state.next_pull++), state.pulls))
      return true;
  }
  state.next_pull = 0;
  return false;
}

// Velocity [rad/s] that the shape wants with the pulls of a round.
ThetaVector wanted_rate(const Stand& stand, std::uint32_t held_mask, const ShapePace& pace,
                        ShapeState& state) noexcept {
  const Index n = static_cast<Index>(stand.space.theta_count);
  const double limit = pace.rate_share * stand.table.limits.theta_rate_rad_s;
  ShapeModel model = resting_model(stand.space, centring_weight(state.weight),
                                   centring(stand.table, held_mask, pace.time_s, stand.theta_rad));
  if (state.weight > 0.0) add_pulls(stand.space, state.pulls, model);
  const ShapeFactor metric = factor(stand.space, model);
  NullPoint rate;
  rate.z = minimum(stand.space, metric, model.pull);
  rate.theta_rad = combine(stand.space, rate.z);
  // The rate limit first: what is far out of bounds at full speed may be inside at this one.
  const double largest = largest_entry(rate.theta_rad, n) / pace.time_s;
  const double share = largest > limit ? limit / largest : 1.0;
  scale_by(stand.space, share / pace.time_s, rate);
  if (may_pass_limit(stand, pace.limit_approach_s, share * largest)) {
    restrict_to(stand.space, metric, room_to_limits(stand.table, stand.theta_rad, 1.0 / pace.limit_approach_s),
                kBoundPasses, state.wanted_held, rate);
    const double bounded = largest_entry(rate.theta_rad, n);
    if (bounded > limit) scale_by(stand.space, limit / bounded, rate);
  }
  return rate.theta_rad;
}

// Change of the velocity over a cycle on its way to what is wanted.
ThetaVector followed_change(const RobotParams& table, const ShapePace& pace, const ShapeState& state) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  const double time_s = kShapeTicks * table.tick_s, share = smaller(1.0, time_s / pace.smoothing_s);
  ThetaVector change{};
  for (Index k = 0; k < n; ++k) change[k] = (state.wanted_rad_s[k] - state.rate_rad_s[k]) * share;
  const double accel = pace.accel_share * table.limits.theta_accel_rad_s2 * time_s, largest = largest_entry(change, n);
  const double slower = largest > accel ? accel / largest : 1.0;  // one factor for all keeps it in the null space
  for (Index k = 0; k < n; ++k) change[k] *= slower;
  return change;
}

// A cycle begins: over it the velocity goes to one in the null space of now, which may have turned far where the tip
// loses a direction; no limit is passed in it. What is held anew (`at_once`) stands still from now on.
void follow(const Stand& stand, bool at_once, const ShapePace& pace, ShapeState& state) noexcept {
  const Index n = static_cast<Index>(stand.space.theta_count);
  NullPoint rate;
  if (at_once) state.rate_rad_s = combine(stand.space, coordinates(stand.space, state.rate_rad_s));
  ThetaVector change = followed_change(stand.table, pace, state);
  for (Index k = 0; k < n; ++k) change[k] += state.rate_rad_s[k];
  rate.z = coordinates(stand.space, change);
  rate.theta_rad = combine(stand.space, rate.z);
  if (may_pass_limit(stand, kLastMoment_s, largest_entry(rate.theta_rad, n))) {
    restrict_to(stand.space, room_to_limits(stand.table, stand.theta_rad, 1.0 / kLastMoment_s), kBoundPasses,
                state.rate_held, rate);
  }
  for (Index k = 0; k < n; ++k) state.change_rad_s[k] = (rate.theta_rad[k] - state.rate_rad_s[k]) / kShapeTicks;
}

// Pulls of a round, some a tick.
void gather_pulls(const RobotParams& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                  const NodeTargets& nodes, const KeepClearTargets& clear, ShapeState& state) noexcept {
  const double weight = larger(largest_weight(table, nodes), largest_weight(clear));
  for (std::uint32_t i = 0; i < kPullsPerTick && !state.is_gathered; ++i)
    state.is_gathered = !gather(table, theta_rad, arm, nodes, clear, weight, state);
}

}  // namespace

double node_excess_m(const RobotParams& table, const ArmKinematics& arm, const NodeTargets& nodes) noexcept {
  double sum_m = 0.0;
  for (const NodeTarget& target : nodes) {
    if (is_node(table, target))
      sum_m += target.weight * larger(0.0, norm(towards_target(arm, target)) - target.threshold_m);
  }
  return sum_m;
}

double largest_weight(const RobotParams& table, const NodeTargets& nodes) noexcept {
  double largest = 0.0;
  for (const NodeTarget& target : nodes) {
    if (is_node(table, target)) largest = larger(largest, target.weight);
  }
  return largest;
}

void add_nodes(const RobotParams& table, const ArmKinematics& arm, const NodeTargets& nodes, PullSum& sum) noexcept {
  for (const NodeTarget& target : nodes) {
    if (is_node(table, target) && target.weight > 0.0) add_node(arm, target, sum);
  }
}

ThetaVector shape_move(const RobotParams& table, const ArmKinematics& arm, const NodeTargets& nodes,
                       const KeepClearTargets& clear, std::uint32_t held_mask, const ShapePace& pace,
                       const ThetaVector& theta_rad, ShapeState& state) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  const bool holds_anew = held_mask != state.held_mask;
  const bool follows = state.tick == kFollowTick || holds_anew;
  const bool solves = state.tick == kSolveTick && state.is_gathered;
  state.held_mask = held_mask;
  if (follows || solves) {
    const NullSpace space = null_space(arm.tip_jacobian, table.theta_count(), held_mask);
    const Stand stand{table, theta_rad, space, min_room_rad(table, theta_rad)};
    if (solves) {
      state.wanted_rad_s = wanted_rate(stand, held_mask, pace, state);
      state.is_gathered = false;
    }
    if (follows) follow(stand, holds_anew, pace, state);
  } else {
    gather_pulls(table, theta_rad, arm, nodes, clear, state);
  }
  ThetaVector move{};
  for (Index k = 0; k < n; ++k) {
    state.rate_rad_s[k] += state.change_rad_s[k];
    move[k] = state.rate_rad_s[k] * table.tick_s;
  }
  return move;
}

}  // namespace liana::cable
