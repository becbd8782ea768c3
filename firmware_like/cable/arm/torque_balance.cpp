#include "firmware_like/cable/arm/torque_balance.hpp"

#include <cmath>

#include "firmware_like/cable/arm/friction_estimator.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

Index segments(const RobotParams& table) noexcept { return static_cast<Index>(table.segment_count); }

double round_s(const RobotParams& table) noexcept { return kFrictionTicks * table.tick_s * table.theta_count(); }

double square(double x) noexcept { return x * x; }

// How sure the exponent of each cable's friction is, for a whole round: rows of different moments would be no
// covariance.
void weigh_friction(const CableLayout& layout, const BalanceReadings& now, std::uint32_t turning,
                    TorqueBalance& state) noexcept {
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    double before = 0.0;
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j) {
      // A cable slides in a segment when that or one between it and the cable's end turns.
      const bool slides = (turning & ((2u << layout.segment[c]) - 1u)) >> j != 0;
      const double resting = slides ? 1.0 - std::fabs(state.slip.sigma[c][j]) : 1.0;
      const double unsure = now.dithered ? kFrictionDithered : kFrictionKnown + kFrictionResting * resting;
      const double part = square((now.mu + now.mu_sd) * now.wrap_rad[j] * unsure);
      state.own[c][j] = before + 0.25 * part;  // half of the segment's bend
      state.shared[c][j] = before + 0.5 * part;
      before += part;
    }
  }
}

// The hardest acceleration of a round counts: a stop that is over within it swings the arm as much as a long one.
void note_rates(const RobotParams& table, const TorqueLimits& limits, const ThetaVector& rate_rad_s,
                TorqueBalance& state) noexcept {
  double change = 0.0;
  for (Index k = 0; k < 2 * segments(table); ++k)
    change += limits.inertia[k / 2] * std::fabs(rate_rad_s[k] - state.rate_rad_s[k]);
  state.rate_rad_s = rate_rad_s;
  state.peak = larger(state.peak, change / (kFrictionTicks * table.tick_s));
}

double slid_until(const BalanceReadings& now, const SegmentVector& sigma, Index own) noexcept {
  double slid_rad = 0.5 * sigma[own] * now.wrap_rad[own];
  for (Index j = 0; j < own; ++j) slid_rad += sigma[j] * now.wrap_rad[j];
  return slid_rad;
}

}  // namespace

TorqueLimits make_torque_limits(const RobotParams& table) noexcept {
  TorqueLimits limits;
  const double gravity_m_s2 = norm(table.gravity_m_s2);
  double reach_m = 0.0, mass_kg = table.tool.mass_kg,
         inertia_kg_m2 = 0.0;  // of the straight arm beyond a segment's root
  for (Index j = segments(table); j-- > 0;) {
    const SegmentParams& segment = table.segment[j];
    double moment_kg_m = 0.0;  // about all of its joints
    for (std::int32_t i = 0; i < segment.modules; ++i) {
      // Everything so far moves one link outwards; the new link's mass is at its end.
      inertia_kg_m2 += segment.module_length_m * (2.0 * reach_m + segment.module_length_m * mass_kg);
      reach_m += segment.module_length_m * mass_kg;
      mass_kg += segment.module_mass_kg;
      reach_m += segment.module_length_m * segment.module_mass_kg;
      inertia_kg_m2 += segment.module_length_m * segment.module_length_m * segment.module_mass_kg;
      moment_kg_m += reach_m;
    }
    if (feeds(segment)) {
      limits.aside_Nm[j] = kTorqueUnknown_Nm;
      continue;
    }
    limits.inertia[j] = segment.modules * std::sqrt(inertia_kg_m2);
    limits.aside_Nm[j] = kTorqueSwing_rad_s2 * segment.modules * inertia_kg_m2;
    if (gravity_m_s2 > 0.0)
      limits.aside_Nm[j] = std::sqrt(square(limits.aside_Nm[j]) + square(kTorqueTilt * gravity_m_s2 * moment_kg_m));
  }
  return limits;
}

void reset_balance(const CableGeometry& geometry, const SlipState& planned, TorqueBalance& state) noexcept {
  state = TorqueBalance{};
  state.slip = planned;
  state.slip.part_m = geometry.part_m;
}

void follow_slides(const CableLayout& layout, const CableGeometry& geometry, const ThetaVector& off_rad, double max_mu,
                   TorqueBalance& state) noexcept {
  constexpr double kLeast_mu = 0.02;  // a cable without friction slides at once
  CableParts part_m = geometry.part_m;
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j)
      part_m[c][j] += dot_pairs(&geometry.jacobian_m_rad[c][2 * j], &off_rad[2 * j], 1);
  }
  advance_slip(layout, part_m, kFeltPresliding_m * larger(kLeast_mu, max_mu), state.slip);
}

void balance_axis(const RobotParams& table, const CableLayout& layout, const TorqueLimits& limits,
                  const BalanceReadings& now, Index axis, TorqueBalance& state) noexcept {
  const Index own = axis / 2;
  note_rates(table, limits, now.rate_rad_s, state);
  if (axis == 0) weigh_friction(layout, now, turning_segments(table, now.rate_rad_s), state);
  double torque_Nm = now.load_Nm, per_mu_Nm = 0.0;
  ThetaVector variance_Nm2{};
  Index c = 0;
  while (static_cast<Index>(layout.segment[c]) < own) ++c;
  for (; c < static_cast<Index>(layout.cable_count); ++c) {
    const double tension_N = larger(now.tension_N[c], table.tension.floor_anywhere_N);
    const double slid_rad = slid_until(now, state.slip.sigma[c], own);
    const double pull_Nm = now.geometry.jacobian_m_rad[c][axis] * exponential(-now.mu * slid_rad) * tension_N;
    const double reading = square(kTorqueGain) + square(now.bias_N / tension_N);
    torque_Nm += pull_Nm;
    per_mu_Nm -= slid_rad * pull_Nm;
    state.pull_Nm[axis][c] = pull_Nm;
    for (Index l = 0; l <= axis; ++l) {
      const double friction = l / 2 == own ? state.own[c][own] : state.shared[c][l / 2];
      variance_Nm2[l] += pull_Nm * state.pull_Nm[l][c] * (reading + friction);
    }
  }
  if (feeds(table.segment[own])) {  // nobody measures what its drives give
    torque_Nm = per_mu_Nm = 0.0;
    variance_Nm2 = ThetaVector{};
  }
  state.per_mu_Nm[axis] = per_mu_Nm;
  for (Index l = 0; l <= axis; ++l) variance_Nm2[l] += square(now.mu_sd) * per_mu_Nm * state.per_mu_Nm[l];
  const double share = round_s(table) / (kFeltFilter_s + round_s(table));
  state.torque_Nm[axis] += share * (torque_Nm - state.torque_Nm[axis]);
  state.variance_Nm2[axis] = variance_Nm2;
  state.whole = state.whole || axis + 1 == 2 * segments(table);
}

// How hard the arm is accelerated, or was a moment ago, counts at every angle.
void end_round(const RobotParams& table, const TorqueLimits& limits, TorqueBalance& state) noexcept {
  state.stir = larger(state.peak, state.stir * (1.0 - round_s(table) / kTorqueCalm_s));
  state.peak = 0.0;
  for (Index k = 0; k < 2 * segments(table); ++k) {
    state.variance_Nm2[k][k] += square(kTorqueFloor_Nm) + square(limits.aside_Nm[k / 2]) +
                                square(kTorqueInertia * limits.inertia[k / 2] * state.stir);
  }
}

}  // namespace liana::cable
