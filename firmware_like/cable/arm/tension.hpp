// Tension plan and elongation: what the motors must pull so that the arm stands where the kinematics says.
//
// Balance B^T t = -Q with B = dL/dtheta weighted by friction (physics study, section 2) and Q the torque that weight
// and springs take at rest (static_load.hpp) and the arm's mass as it is commanded to accelerate: cables that are
// pulled so, and lengthened so, leave no swing behind. Segments are swept from the tip to the root: the cables of a
// segment are the only ones left that turn its two angles, so each sweep solves two equations for its cables and has
// freedom left to bring them near the planned tension and above the floor. All formulas are smooth, so that tensions
// never jump. The drives of a base that feeds have none: 0 N, whatever their axes carry.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/friction.hpp"

namespace liana::cable {

// All newtons below are those of an arm that plans 40 N, and are taken times TensionLimits::scale.
//
// Planned tension stays this far above the floor: motion and unknown friction take up to 20 N off a cable (measured
// over whole missions).
constexpr double kFloorMargin_N = 22.0;
constexpr double kMarginFriction =
    0.08;  // above this mu the margin shrinks with 1 / mu: friction spreads tensions, and less fits under the ceiling
// Of the ceiling, up to which that margin may raise tensions: with 0.7 a cable came down to 12.8 N in a crossing, and
// with 0.92 the friction of worn cables took one off. What a load adds to one cable and takes off another comes on top,
// so that the lowest stays where it is, up to the second share.
constexpr double kCeilingShare = 0.8;
constexpr double kLoadLift = 2.0;
constexpr double kLoadCeilingShare = 0.95;

struct TensionPlan {
  CableVector motor_N{};
  ThetaVector load_Nm{};          // that they give about each theta
  SegmentVector spread_N{};       // between the cables of each segment at rest
  bool floor_acted = false;       // tension was raised to keep the floor
  bool ceiling_exceeded = false;  // a planned tension is over the ceiling of free motion
  bool balanced = true;           // false: a segment's cables cannot turn both angles (degenerate table)
};

// The two equations of one segment, [p; q] t = rhs, over its own cables, and what all cables do to its angles.
struct SegmentBalance {
  std::array<double, kMaxSegmentCables> p{}, q{};
  double pp = 0.0, pq = 0.0, qq = 0.0, det = 0.0;
};
struct TensionSolver {
  std::array<SegmentBalance, kMaxSegments> segment{};
  std::array<ThetaVector, kMaxCables> pull_m{};  // torque about each theta per newton at the motor
};
TensionSolver tension_solver(const RobotParams& table, const CableGeometry& geometry,
                             const TensionRatio& ratio) noexcept;

// Least changes of tension, segment by segment from the tip, that give `load_Nm` about each theta; zero where a segment
// cannot turn both of its angles. Linear. Cost: two operations per cable and theta that it passes.
CableVector pulls_for(const RobotParams& table, const TensionSolver& solver, const ThetaVector& load_Nm) noexcept;

// What the cables are to give about each theta: weight and springs of the arm at rest, and what its mass takes besides.
struct PlannedLoad {
  ThetaVector static_Nm{};
  ThetaVector inertia_Nm{};
};

// Plan at one pose around the table's level at the motor, every segment `lift_N` further above the floor (zero: as
// planned without measurements; below zero: so much lower, the floor itself kept). Residual torque is below 1e-9 N m
// when balanced.
TensionPlan plan_tension(const RobotParams& table, const CableGeometry& geometry, const TensionRatio& ratio,
                         const SegmentVector& lift_N, const PlannedLoad& load = {}) noexcept;

// Friction that the plan does not know can take a cable further down than the margin. A segment whose lowest measured
// tension nears the floor is pulled tighter, which turns no joint. First order, slower than the arm's modes. The more
// friction, the less lift, and none above kMarginFriction: there more tension brings more friction than it repairs
// (with mu 0.1 it let cables go slack in whole missions).
constexpr double kLiftBelow_N = 9.0;   // over the floor: under it the lift rises
constexpr double kLiftRate_1_s = 3.0;  // share of what is missing, per second
constexpr double kLiftLeak_s = 5.0;    // time constant of letting go
constexpr double kLiftLimit_N = 20.0;  // without friction

// One tick of that lift from measured tensions at the motor, low-passed.
void keep_min_tension(const RobotParams& table, const CableVector& tension_N, SegmentVector& lift_N) noexcept;

// An arm that friction holds beside its command has cables that are looser than planned, whatever the segment is pulled
// to: a single cable that nears the floor is wound in. While friction holds the arm this moves nothing, so it may be
// quicker than the arm's modes: at 3 / s from the floor on, a hand's cable came down to 0.3 N where it now has 6.6. Out
// of a bend at the limits of both angles it takes 90 N until friction has turned round.
constexpr double kTautBelow_N = 5.0;    // over the floor: under it a cable is wound in
constexpr double kTautRate_1_s = 10.0;  // share of what is missing, per second; more would oscillate for its own lag
constexpr double kTautLeak_s = 10.0;
constexpr double kTautLimit_N = 240.0;

// One tick of what each cable is pulled beyond the plan, from measured tensions at the motor, low-passed.
void wind_in(const RobotParams& table, const CableVector& tension_N, CableVector& taut_N) noexcept;

// Unstretched length from drum to anchor when the cables are pulled with motor_N: the elastic part is taken off piece
// by piece.
CableVector payout_for(const RobotParams& table, const CableLayout& layout, const CableParts& part_m,
                       const TensionRatio& ratio, const CableVector& motor_N) noexcept;

}  // namespace liana::cable
