// The offline side of the shape: to the nearest minimum of what is wanted, along the null space of a given tip pose.
// For goals and plans, outside the tick.
#pragma once

#include <cstdint>

#include "firmware_like/cable/motion/servo_ik.hpp"
#include "firmware_like/cable/shape/keep_clear.hpp"
#include "firmware_like/cable/shape/shape.hpp"

namespace liana::inverse_kinematics {

using namespace cable;  // this room serves the cable arm only

constexpr double kTipTolerance = 1e-7;           // m and rad; half a decade inside what is promised (1e-6)
constexpr std::int32_t kImproveSteps = 100;      // along the null space, at most
constexpr std::int32_t kImproveIterations = 8;   // for the tip after each step, at most
constexpr double kImproveLargestStep_rad = 0.1;  // of any theta, per step

struct ShapeProblem {
  IkGoal goal{};
  NodeTargets node{};
  KeepClearTargets clear{};
};

struct TipError {
  double position_m = 0.0;
  double attitude_rad = 0.0;
  double size2() const noexcept { return position_m * position_m + attitude_rad * attitude_rad; }
  bool converged() const noexcept { return position_m < kTipTolerance && attitude_rad < kTipTolerance; }
};
TipError tip_error(const Pose& goal, const Pose& tip) noexcept;

// Iterates the servo IK until the tip is there, `most` iterations are done, or the error no longer halves with each
// after `patience` of them. Returns the error reached; adds to `iterations`.
TipError approach_tip(const RobotParams& table, const IkGoal& goal, std::int32_t patience, std::int32_t most,
                      ThetaVector& theta_rad, std::int32_t& iterations) noexcept;

// True when something is wanted of the shape.
bool wants_shape(const RobotParams& table, const ShapeProblem& problem) noexcept;

// Sum [m] of weighted excesses of nodes and missing clearances.
double shape_sum_m(const RobotParams& table, const ShapeProblem& problem, const ThetaVector& theta_rad) noexcept;

// Steps of the shape model, each corrected to the tip pose, kept when the sum falls and halved when it does not.
// `theta_rad` has to be at the goal already and stays there; limits and held thetas are respected. Returns the sum
// reached; adds to `iterations`.
double improve_shape(const RobotParams& table, const ShapeProblem& problem, ThetaVector& theta_rad,
                     std::int32_t& iterations) noexcept;

// How far a node can go for the current tip: its distance to `target_m` now, and the least one along the null space
// from here. For the way in a direction, give a point some arm lengths out: now_m - least_m.
struct NodeReach {
  double now_m = 0.0;
  double least_m = 0.0;
};
NodeReach node_reach(const RobotParams& table, const IkGoal& goal, const ThetaVector& theta_rad, std::int32_t node,
                     const Vec3& target_m) noexcept;

}  // namespace liana::inverse_kinematics
