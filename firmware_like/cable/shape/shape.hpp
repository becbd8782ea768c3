// Shape: what the arm does with the freedom that the tip leaves (requirements A42 to A45). Method and
// figures: docs/explanation/shape.md.
//
// Each tick takes the step that would bring the nodes to their targets at once, or as near as a quadratic model says
// (shape_model.hpp), in the null space of the tip, over the pace's time. Its fixed point is a minimum of sum lambda_j
// d_j. What the nodes leave free is drawn to the middle of the joints (centring), with kLeadWeight on the pitch of the
// segment next to enter a planar part (the first free one before held pitches): it has to come into the plane before it
// reaches the slit. Joint limits are bounds of the same problem.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/cable/shape/bounds.hpp"
#include "firmware_like/cable/shape/keep_clear.hpp"
#include "firmware_like/operator_input/tip_filter.hpp"

namespace liana::cable {

constexpr double kCentringRate_1_s = 0.2;  // of every theta, where no node target is given
constexpr double kCentringShare = 0.02;    // m2/rad2 times the largest node weight: centring beside node targets
constexpr double kLeadWeight = 15.0;       // found good from 10 to 20 for the slit, for one and two planar segments

struct ShapePace {
  double time_s;            // in which distances would fall to 1 / e without rate limits
  double rate_share;        // of the theta rate limit
  double accel_share;       // of the theta acceleration limit
  double smoothing_s;       // how the shape velocity follows what is wanted
  double limit_approach_s;  // room to a limit over this bounds the wanted rate
};
constexpr ShapePace kShapeBesideTip{1.0, 0.35, 0.1, 0.5, 2.0};  // the shape has to keep up with the tip
// The shape moves most of the arm's mass and the tension plan knows no inertia: 1 deg/s2 of all thetas takes some 100 N
// off a cable. With the pace above, long ways of the shape let cables go slack (docs/explanation/shape.md).
constexpr ShapePace kShapeAlone{0.75, 0.15, 0.025, 0.75, 6.0};

// Sum over the nodes of lambda_j max(0, d_j - threshold_j) [m]: what add_nodes works on.
double node_excess_m(const RobotParams& table, const ArmKinematics& arm, const NodeTargets& nodes) noexcept;

// Largest weight of a node target; 0 when there is none.
double largest_weight(const RobotParams& table, const NodeTargets& nodes) noexcept;

// Adds what the nodes want at `arm`. A node within its threshold wants nothing; one outside wants to come back within.
void add_nodes(const RobotParams& table, const ArmKinematics& arm, const NodeTargets& nodes, PullSum& sum) noexcept;

// The shape's work is spread over a cycle of ticks: in one the velocity that is kept until the next cycle, in one the
// velocity that is wanted, in the others pulls. The null space turns by less than 0.1 deg within a cycle; the servo IK
// makes up for what that leaks into the tip.
constexpr std::uint32_t kShapeTicks = 10;
constexpr std::uint32_t kFollowTick = 0;
constexpr std::uint32_t kSolveTick = 3;
constexpr std::uint32_t kPullsPerTick = 2;  // in the other ticks

// What the shape keeps between ticks. Pulls are gathered, all of them in a round; then the wanted velocity is solved
// for. The most that a round can take is 20 ticks, four nodes and four points to keep clear of.
struct ShapeState {
  ThetaVector rate_rad_s{};    // null-space velocity
  ThetaVector change_rad_s{};  // of it in each tick until the next cycle
  ThetaVector wanted_rad_s{};  // of the last round: what the velocity follows
  PullSum pulls{};             // of this round so far
  double weight = 0.0;         // largest of its targets
  std::uint64_t next_pull = 0;
  bool is_gathered = false;     // the round is complete
  std::uint32_t tick = 0;       // of the cycle, 0 .. kShapeTicks - 1: whoever moves the shape counts it on every tick
  std::uint32_t held_mask = 0;  // of the last tick
  HeldBounds wanted_held{}, rate_held{};
};

// Shape motion of one tick [rad] at theta, whose kinematics are `arm`: within joint limits, at most the pace's share of
// the rate limit (1 % more while the null space turns), held thetas still, |J move| <= 1e-9 |move| where a cycle ends
// but for what the null space has turned by in it. The velocity in `state` follows what is wanted smoothly, so that a
// new target never jerks the arm.
ThetaVector shape_move(const RobotParams& table, const ArmKinematics& arm, const NodeTargets& nodes,
                       const KeepClearTargets& clear, std::uint32_t held_mask, const ShapePace& pace,
                       const ThetaVector& theta_rad, ShapeState& state) noexcept;

}  // namespace liana::cable
