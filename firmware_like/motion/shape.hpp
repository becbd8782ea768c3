// Shape: what the arm does with the freedom that the tip leaves (mission figure A6, requirements A42-A45).
//
// Null-space velocity = N (nodes) + N (centring), N the true projector onto the null space of the tip Jacobian over the free thetas: an
// orthonormal basis of J's rows, not a damped inverse, so that |J dtheta| <= 1e-9 |dtheta|.
// Nodes: steepest descent of sum lambda_j d_j, its length chosen so that the sum decays with kNodeRate; near an unreachable minimum it
// fades out. Centring: -theta, with kLeadWeight on the pitch of the segment next to enter a planar part (the first free one before held
// pitches): it has to come into the plane before it reaches the slit. Without centring the arm's middle drifts into the panel.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/arm/kinematics.hpp"
#include "firmware_like/telecommand.hpp"

namespace liana {

constexpr double kNodeRate_1_s = 1.0;
constexpr double kNodeFade_m_rad = 0.2;  // descent fades where a null-space radian brings less than this
constexpr double kCentringRate_1_s = 0.2;
constexpr double kLeadWeight = 15.0;       // found good from 10 to 20 for the slit, for one and two planar segments
constexpr double kShapeShare = 0.35;       // of the theta rate limit
constexpr double kShapeAccelShare = 0.1;   // of the theta acceleration limit: the shape moves most of the arm's mass
constexpr double kShapeSmoothing_s = 0.5;  // how the shape velocity follows what is wanted

using NodeTargets = std::array<NodeTarget, kMaxNodeTargets>;

// Projector onto the null space of the tip Jacobian over free thetas.
struct NullSpace {
  std::array<ThetaVector, 6> row{};  // orthonormal rows
  std::int32_t rank = 0;
  std::uint32_t fixed = 0;  // bit i: theta i does not move
  std::int32_t theta_count = 0;
};
NullSpace null_space(const Jacobian& J, std::int32_t theta_count, std::uint32_t fixed) noexcept;
ThetaVector project(const NullSpace& space, const ThetaVector& v) noexcept;

// sum lambda_j d_j [m] over the nodes farther away than their thresholds, and its negative gradient by theta.
struct NodeCost {
  double sum_m = 0.0;
  ThetaVector descent{};
};
NodeCost node_cost(const RobotTable& table, const ArmKinematics& arm, const NodeTargets& nodes) noexcept;

// Shape motion of one tick [rad] at theta, whose kinematics are `arm`: within joint limits, at most kShapeShare of the rate limit, held
// thetas still. `rate_rad_s` is the shape velocity kept between ticks: it follows what is wanted (zero while braking) smoothly, so that a
// new target never jerks the arm.
ThetaVector shape_move(const RobotTable& table, const ArmKinematics& arm, const NodeTargets& nodes, std::uint32_t held_mask, bool braking,
                       const ThetaVector& theta_rad, ThetaVector& rate_rad_s) noexcept;

}  // namespace liana
