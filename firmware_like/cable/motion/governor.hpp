// How hard the arm may be accelerated here: as hard as its cables can, between their floor and the ceiling of free
// motion, at the pose where it stands.
//
// Torque that accelerates the arm is a change of tensions, planned with the motion (arm/tension.hpp). What a pose
// leaves of the way from floor to ceiling is the room for it. The governor keeps, for every cable, the tension that a
// unit of acceleration of each angle takes: G = D M, M the mass matrix and D the plan's own sweep from torques to
// tensions. The tip filter's accelerations are bounded so that G a stays in the room whichever way the tip goes, and a
// tick's motion so that it does in fact: an explicit reference governor (docs/explanation/arm-control.md, where others
// are compared).
#pragma once

#include <cmath>

#include "firmware_like/cable/arm/body_inertia.hpp"
#include "firmware_like/cable/arm/tension.hpp"
#include "firmware_like/math/slow_directions.hpp"

namespace liana::cable {

// Newtons below are those of an arm that plans 40 N, taken times TensionLimits::scale.
constexpr double kGovernorKeep_N = 18.0;  // over the floor, for friction and swing that no plan knows
constexpr double kGovernorFeed_N = 1e9;   // room of a base that feeds: as much as its limits of motion ask for
constexpr double kGovernorLeast_N = 4.0;  // room where a pose leaves none: the way out of it
constexpr double kGovernorAlone = 0.4;    // of a theta's acceleration limit, where it slows down by itself
constexpr double kGovernorTip = 0.55;     // of room and rates, for the tip's way alone and for its turn alone
constexpr double kGovernorSpeed = 0.7;    // of the acceleration: where less of it is missing, none of the speed is
// Where thetas turn with v / s and are accelerated by v^2 / s^3, s the Jacobian's least singular value, with which the
// share of the rates goes, the speed falls with the power 2.5 of what the rates leave in every direction.
constexpr double kGovernorLoss = 6.0;
// A direction that has less than such a share of the speed of the best one is lost: the tip goes there more slowly,
// with the power 3.5 of what is missing, and in the others as if it were not lost.
constexpr double kGovernorLost = 0.3;
constexpr double kGovernorNearLost = 0.5;     // of the tip's acceleration limit, where a direction is lost
constexpr std::uint32_t kGovernorCycles = 3;  // of the shape's ten ticks: it looks anew in so many of them

struct GovernorState {
  MassMatrix mass_kg_m2{};
  std::array<ThetaVector, kMaxCables> pull_N_s2{};  // G: newtons per rad/s2
  SegmentVector room_N{};                           // of each segment's cables, up as down
  ThetaVector accel_rad_s2{};                       // of each theta alone that stays in the room
  std::uint32_t cycle = 0;                          // 0: it looks
  double linear_share = 1.0, angular_share = 1.0;   // of the table's limits of the tip's acceleration
  double speed_share = 1.0, turn_share = 1.0;       // of its limits of the tip's speeds
  SlowDirections slow_ways{}, slow_turns{};         // in which the tip takes less of all these, in the base frame
};

// Room for the cables of every segment under a plan at rest.
void take_room(const RobotParams& table, const TensionPlan& plan, GovernorState& state) noexcept;

// One tick of the look: dear work is spread over ticks 5, 6, 8 and 9 of three cycles, which have little else to do.
// Before the arm may move it has looked for seconds. Cost: 9,000 instructions in one of these ticks.
void look_at_load(const RobotParams& table, const CableGeometry& geometry, const TensionRatio& ratio,
                  const ArmKinematics& arm, std::uint32_t held_mask, std::uint32_t tick, GovernorState& state) noexcept;

// Share of the room that this acceleration takes; over 1: more than there is.
double room_taken(const RobotParams& table, const ThetaVector& accel_rad_s2, const GovernorState& state) noexcept;

// Shares s of a tick's step with least <= |s| <= most for which acceleration from `now` stays in the room: (s asked -
// now) / tick.
struct LoadShares {
  double least = 0.0, most = 1.0;
};
LoadShares shares_in_room(const RobotParams& table, const ThetaVector& asked_rad_s, const ThetaVector& now_rad_s,
                          const GovernorState& state) noexcept;

}  // namespace liana::cable
