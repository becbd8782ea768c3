// Shape: what the arm does with the freedom that the tip leaves (mission figure A6, requirements A42-A45). Method and
// figures: docs/shape.md.
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
// off a cable. With the pace above, long ways of the shape let cables go slack (docs/shape.md).
constexpr ShapePace kShapeAlone{0.75, 0.15, 0.025, 0.75, 6.0};

// Sum over the nodes of lambda_j max(0, d_j - threshold_j) [m]: what add_nodes works on.
double node_excess_m(const RobotTable& table, const ArmKinematics& arm, const NodeTargets& nodes) noexcept;

// Largest weight of a node target; 0 when there is none.
double largest_weight(const RobotTable& table, const NodeTargets& nodes) noexcept;

// Adds what the nodes want at `arm`. A node within its threshold wants nothing; one outside wants to come back within.
void add_nodes(const RobotTable& table, const ArmKinematics& arm, const NodeTargets& nodes, PullSum& sum) noexcept;

// What the shape keeps between ticks. Pulls are gathered one a tick, all of them in a round; then the wanted velocity
// is solved for. The most that a round can take is 25 ticks, four nodes and four points to keep clear of; without any
// targets it is one.
struct ShapeState {
  ThetaVector rate_rad_s{};    // null-space velocity
  ThetaVector wanted_rad_s{};  // of the last round: what the velocity follows
  PullSum pulls{};             // of this round so far
  double weight = 0.0;         // largest of its targets
  std::uint64_t next_pull = 0;
  HeldBounds wanted_held{}, rate_held{};
};

// Shape motion of one tick [rad] at theta, whose kinematics are `arm`: within joint limits, at most the pace's share of
// the rate limit (1 % more while the null space turns), held thetas still, |J move| <= 1e-9 |move|. The velocity in
// `state` follows what is wanted (zero while braking) smoothly, so that a new target never jerks the arm.
ThetaVector shape_move(const RobotTable& table, const ArmKinematics& arm, const NodeTargets& nodes,
                       const KeepClearTargets& clear, std::uint32_t held_mask, bool braking, const ShapePace& pace,
                       const ThetaVector& theta_rad, ShapeState& state) noexcept;

}  // namespace liana::cable
