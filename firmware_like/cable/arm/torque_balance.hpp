// Which torque about each angle neither cables, friction nor the arm's mass explain, and how sure that is.
//
// Friction is taken off as it is felt: the angles that the lengths show, not the commanded ones, say which way every
// cable has slid, so that a push that moves a resting arm turns friction round here, too. The errors that are left
// belong to cables, and a cable pulls at every segment that it passes: they are kept as a covariance over all angles.
// Derivation and measured errors: docs/explanation/contact-force.md.
#pragma once

#include <array>

#include "firmware_like/cable/arm/body_inertia.hpp"
#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/friction.hpp"

namespace liana::cable {

constexpr double kFeltPresliding_m = 2e-3;  // of slides that are measured, times the most that mu may be
constexpr double kFeltFilter_s = 0.6;       // of the torques, one look at all angles after the other

// Deviations of what the balance takes for given.
constexpr double kTorqueGain = 0.01;          // of each cable's torque reading
constexpr double kFrictionKnown = 0.3;        // share of friction where a cable slides
constexpr double kFrictionResting = 1.3;      // more, where it rests
constexpr double kFrictionDithered = 0.5;     // the same after a dither, which leaves friction nowhere to stay
constexpr double kTorqueFloor_Nm = 1.0;       // about every angle
constexpr double kTorqueSwing_rad_s2 = 1e-3;  // the body beyond an angle swings with so much, unmeasured
constexpr double kTorqueTilt = 0.012;         // rad; weight pulls so far beside where the table has it
constexpr double kTorqueInertia = 0.07;       // share of the most that commanded acceleration can ask for
constexpr double kTorqueUnknown_Nm = 1e6;     // of a base that feeds: its axes say nothing
constexpr double kTorqueCalm_s = 2.0;         // swing after an acceleration is forgotten in

using TorqueMatrix = std::array<ThetaVector, kMaxTheta>;  // the lower triangle

// Figures of the straight arm, derived once from the robot table.
struct TorqueLimits {
  SegmentVector aside_Nm{};  // at a segment's angles: unmeasured swing, and weight beside its direction
  SegmentVector inertia{};   // modules times the root of the inertia beyond, kg^0.5 m: the product of two segments' is
                             // the most that one's acceleration asks of the other
};
TorqueLimits make_torque_limits(const RobotParams& table) noexcept;

struct TorqueBalance {
  bool whole = false;                              // every axis has been balanced
  SlipState slip{};                                // felt
  ThetaVector per_mu_Nm{};                         // change of the torques with mu
  ThetaVector torque_Nm{};                         // that nothing explains, low-passed
  TorqueMatrix variance_Nm2{};                     // of it
  std::array<CableVector, kMaxTheta> pull_Nm{};    // of every cable about each angle
  std::array<SegmentVector, kMaxCables> own{};     // variance of friction's exponent in the middle of each segment
  std::array<SegmentVector, kMaxCables> shared{};  // of it, what later segments share
  ThetaVector rate_rad_s{};                        // commanded when the last axis was balanced
  double peak = 0.0;                               // acceleration of all segments in this round, each times `inertia`
  double stir = 0.0;                               // the same of earlier rounds; fades
};

// What one tick knows of the arm.
struct BalanceReadings {
  const CableGeometry& geometry;  // as commanded
  const SegmentVector& wrap_rad;
  const CableVector& tension_N;   // measured, low-passed
  const ThetaVector& rate_rad_s;  // commanded
  double mu;                      // as found
  double mu_sd;                   // its standard deviation
  double load_Nm;                 // what weight, springs and the arm's mass take about the axis
  double bias_N;                  // deviation of each drive's zero of torque, drift in it
  bool dithered;                  // nothing has moved since a dither
};

// The arm stands here; which way its cables have slid last is as planned.
void reset_balance(const CableGeometry& geometry, const SlipState& planned, TorqueBalance& state) noexcept;

// Follows the slides of all cables; `off_rad` is measured less commanded, `max_mu` the most that friction may be.
// Cost: eight operations per cable and segment passed.
void follow_slides(const CableLayout& layout, const CableGeometry& geometry, const ThetaVector& off_rad, double max_mu,
                   TorqueBalance& state) noexcept;

// One axis anew; axes come in order, from 0. Cost: one exponential per cable, four operations per cable and earlier
// axis.
void balance_axis(const RobotParams& table, const CableLayout& layout, const TorqueLimits& limits,
                  const BalanceReadings& now, std::size_t axis, TorqueBalance& state) noexcept;

// After the last axis: what motion itself hides is added to the variances.
void end_round(const RobotParams& table, const TorqueLimits& limits, TorqueBalance& state) noexcept;

}  // namespace liana::cable
