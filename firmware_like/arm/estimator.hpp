// Joint angles back from motor lengths and tensions: least squares, one Gauss-Newton step per tick.
#pragma once

#include <cstdint>

#include "firmware_like/arm/cables.hpp"
#include "firmware_like/arm/friction.hpp"

namespace liana {

struct EstimatorState {
  ThetaVector theta_rad{};        // the estimate
  ArmTrig trig{};                 // of the estimate, once primed
  CableVector tension_N{};        // measured, low-passed
  CableVector residual_m{};       // measured path minus the path of the estimate
  CableParts part_m{};            // cable paths of the estimate before its last step
  double largest_step_rad = 0.0;  // of the last Gauss-Newton step: small means converged
  bool primed = false;            // the first measurement has been taken as it is
};

// Time constant of the tension low-pass: drive torque is quantised to 0.6 N.
constexpr double kTensionFilter_s = 0.02;

// One Gauss-Newton step towards the angles that explain `payout_m` (unstretched lengths) pulled with `tension_N`, both measured, with
// friction as planned (`ratio`). `geometry` and `solver` may belong to a pose near the estimate: the commanded angles, which saves a
// second factorisation per tick; what they are off only slows convergence, the paths themselves are taken at the estimate.
void estimate(const RobotTable& table, const CableLayout& layout, const CableGeometry& geometry, const CableSolver& solver,
              const TensionRatio& ratio, const CableVector& payout_m, const CableVector& tension_N, EstimatorState& state) noexcept;

}  // namespace liana
