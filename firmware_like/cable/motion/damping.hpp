// Active damping of the arm's slow modes from measured cable tensions.
//
// Without friction nothing stops a swing of such an arm (physics study, section 4). The elastic deflection delta of the
// angles against their motors follows from measured minus planned tension. Moving the motors after it, shift' = c
// delta, turns s^2 + w^2 into s^2 + c s + w^2: every mode decays with c / 2, whatever its frequency or mass. A
// high-pass keeps standing errors (friction, tension gain) out, and a lead makes up for the lag of motor and tension
// filter.
#pragma once

#include "firmware_like/cable/arm/estimator.hpp"

namespace liana::cable {

constexpr double kDampingRate_1_s = 1.0;     // c
constexpr double kDampingHighPass_s = 4.0;   // standing deflection is forgotten
constexpr double kDampingLeak_s = 4.0;       // the shift returns to zero
constexpr double kDampingLimit_rad = 0.005;  // about 0.3 deg: never more than a correction

struct DampingState {
  ThetaVector standing_rad{};  // slow part of the deflection
  ThetaVector shift_rad{};     // what the motors are moved by, before the lead
  ThetaVector output_rad{};    // added to the commanded angles at the motors; stands still while a cable fault makes
                               // tensions doubtful
};

// One tick; output_rad is to be added to the commanded angles before the cable map. `stretch_m` is how much longer the
// cables are than planned, from measured less planned tensions.
void damp(const RobotParams& table, const CableGeometry& geometry, const CableSolver& solver,
          const CableVector& stretch_m, DampingState& state) noexcept;

}  // namespace liana::cable
