// Joint angles back from motor lengths and tensions: least squares, one Gauss-Newton step per tick.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/friction.hpp"

namespace liana::cable {

struct EstimatorState {
  ThetaVector theta_rad{};        // the estimate
  CableVector tension_N{};        // measured, low-passed
  CableVector residual_m{};       // part of the measured paths that no angles explain
  double largest_step_rad = 0.0;  // of the last tick: small means converged
  bool primed = false;            // the first measurement has been taken as it is
};

// Time constant of the tension low-pass: drive torque is quantised to 0.6 N.
constexpr double kTensionFilter_s = 0.02;

// Where the cables are linearised: a pose near the arm's, the commanded one. An estimate delta away from it is off by
// about delta^2 / 2 (1e-5 rad for a deflection of 0.3 deg).
struct CableModel {
  ThetaVector theta_rad{};
  CableGeometry geometry{};
  CableSolver solver{};
};

// Angles that explain `payout_m` (unstretched lengths) pulled with `tension_N`, both measured, with friction as planned
// (`ratio`). Moves by 0.1 rad a tick at most; a model that follows the estimate makes this Gauss-Newton's method.
void estimate(const RobotParams& table, const CableLayout& layout, const CableModel& model, const TensionRatio& ratio,
              const CableVector& payout_m, const CableVector& tension_N, EstimatorState& state) noexcept;

}  // namespace liana::cable
