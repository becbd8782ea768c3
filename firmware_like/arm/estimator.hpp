// Joint angles back from motor lengths and tensions: least squares, one Gauss-Newton step per tick.
#pragma once

#include <cstdint>

#include "firmware_like/arm/cables.hpp"
#include "firmware_like/arm/friction.hpp"
#include "firmware_like/math/cholesky.hpp"

namespace liana {

// Least squares of angles against cable paths at one pose: argmin |J dtheta - change|, J = d length / d theta.
struct CableSolver {
  CableGeometry geometry{};
  SquareMatrix<kMaxTheta> factor{};  // Cholesky factor of J^T J
  bool regular = false;              // false: J is singular, solutions are zero
};

// Takes over the pose. Cost: one cable geometry, J^T J and its factorisation.
void update_cable_solver(const RobotTable& table, const CableLayout& layout, const ArmTrig& trig, CableSolver& solver) noexcept;

// Angles by which a change of cable paths moves the arm.
ThetaVector solve_cables(const RobotTable& table, const CableLayout& layout, const CableSolver& solver,
                         const CableVector& change_m) noexcept;

struct EstimatorState {
  ThetaVector theta_rad{};        // the estimate
  CableVector tension_N{};        // measured, low-passed
  CableVector residual_m{};       // measured path minus the path of the estimate
  CableSolver solver{};           // at the estimate before its last step
  double largest_step_rad = 0.0;  // of the last Gauss-Newton step: small means converged
  bool primed = false;            // the first measurement has been taken as it is
};

// Time constant of the tension low-pass: drive torque is quantised to 0.6 N.
constexpr double kTensionFilter_s = 0.02;

// One Gauss-Newton step towards the angles that explain `payout_m` (unstretched lengths) pulled with `tension_N`, both measured, with
// friction as planned (`ratio`).
void estimate(const RobotTable& table, const CableLayout& layout, const TensionRatio& ratio, const CableVector& payout_m,
              const CableVector& tension_N, EstimatorState& state) noexcept;

}  // namespace liana
