// Joint angles back from motor lengths and tensions: least squares, a fixed number of Gauss-Newton steps per tick.
#pragma once

#include <cstdint>

#include "firmware_like/arm/cables.hpp"
#include "firmware_like/arm/friction.hpp"

namespace liana {

struct EstimatorState {
  ThetaVector theta_rad{};        // the estimate
  CableVector tension_N{};        // measured, low-passed
  CableVector residual_m{};       // measured path minus the path of the estimate
  double largest_step_rad = 0.0;  // of the last Gauss-Newton step: small means converged
  bool primed = false;            // the first measurement has been taken as it is
};

// Time constant of the tension low-pass: drive torque is quantised to 0.6 N.
constexpr double kTensionFilter_s = 0.02;

// One Gauss-Newton step towards the angles that explain `payout_m` (unstretched lengths) pulled with `tension_N`, both measured.
// Cost: one cable Jacobian and one 10 x 10 Cholesky factorisation.
void estimate(const RobotTable& table, const CableLayout& layout, const SlipState& slip, const CableVector& payout_m,
              const CableVector& tension_N, EstimatorState& state) noexcept;

// Angles by which a change of cable path moves the arm: argmin |J dtheta - change|, J = geometry's Jacobian. Zero when singular.
ThetaVector least_squares_theta(const RobotTable& table, const CableGeometry& geometry, const CableVector& change_m) noexcept;

}  // namespace liana
