// The outer laws of force control, one step of a tick each (docs/explanation/force-control.md). Both make a tip
// velocity:
//
//   force:      M_d dv/dt = K_P C_F (F - F_e) - K_D v       (Liu et al., eqs 16-19, without the position term)
//   impedance:  M_d dv/dt = K_P (x_d - x) - F_e - K_D v
//
// F is what the arm should give, F_e what it gives. K_D differs along the insertion axis, across it and in turning. The
// damping is implicit: v' = (v + h/M f) / (1 + h/M K_D), which is stable for every gain.
#pragma once

#include <cstdint>

#include "firmware_like/serial/kinematics.hpp"
#include "firmware_like/serial/torque_params.hpp"

namespace liana::serial {

enum class InsertLaw : std::uint8_t { kForce = 0, kImpedance = 1 };

// Across the axis less than this is nothing to move for.
constexpr double kLateralDeadBand_N = 1.0;
constexpr double kTurnDeadBand_Nm = 0.5;

// All vectors in one frame.
struct LawInputs {
  double tick_s = 0.0;
  Vec3 axis{0.0, 0.0, 1.0};    // unit, the way in
  Wrench set{};                // F
  Wrench given{};              // F_e
  Vec3 away_m{};               // x_d - x; impedance only
  Vec3 away_rad{};             // the same of attitude, as a rotation vector
  double axial_damping = 0.0;  // K_D along the axis [N.s/m]
};

// What moves the tip: right-hand side of the law without damping. Dead bands are applied across the axis and in turning
// by the force law only: there nothing else would keep a sensor's noise from moving the arm.
Wrench drive_of(InsertLaw law, const InsertGains& gains, const LawInputs& in) noexcept;

// Velocity after a tick.
Twist law_step(InsertLaw law, const InsertGains& gains, const LawInputs& in, const Twist& velocity) noexcept;

}  // namespace liana::serial
