#include "firmware_like/cable/arm/friction_estimator.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

// The torques about one axis.
struct AxisBalance {
  double torque_Nm = 0.0;   // left over with friction as found
  double per_mu_Nm = 0.0;   // how it changes with mu
  double unsure_Nm2 = 0.0;  // variance: cables that have not slid far enough to know which way friction acts
};

AxisBalance balance_about(const CableLayout& layout, const FrictionReadings& now, std::uint32_t turning, double mu,
                          Index axis) noexcept {
  AxisBalance out;
  const Index own = axis / 2;
  const double more_mu = mu - now.planned_mu;
  SegmentVector part_rad;  // bend until the middle of the axis' segment
  double bend_rad = 0.0;
  for (Index j = 0; j <= own; ++j) {
    part_rad[j] = j < own ? now.wrap_rad[j] : 0.5 * now.wrap_rad[j];
    bend_rad += part_rad[j];
  }
  Index c = 0;
  while (static_cast<Index>(layout.segment[c]) < own) ++c;
  for (; c < static_cast<Index>(layout.cable_count); ++c) {
    const double* const sigma = now.slip.sigma[c].data();
    // A cable slides in a segment when that or one between it and the cable's end turns; where it rests, each change of
    // tension may turn friction round.
    const std::uint32_t until_end = turning & ((2u << layout.segment[c]) - 1u);
    double slid_rad = 0.0, sliding_rad = 0.0, resting_rad = bend_rad;
    for (Index j = 0; j <= own; ++j) {
      const double slid = sigma[j] * part_rad[j];
      slid_rad += slid;
      if (until_end >> j == 0) continue;
      sliding_rad += slid;
      resting_rad -= std::fabs(slid);
    }
    // exp(-mu slid) from the planned ratio, to the second order of what was found beyond it.
    const double x = more_mu * slid_rad;
    const double torque_Nm =
        now.geometry.jacobian_m_rad[c][axis] * now.ratio[c][own] * now.tension_N[c] * (1.0 - x + 0.5 * x * x);
    const double unsure = resting_rad * torque_Nm;
    out.torque_Nm += torque_Nm;
    out.per_mu_Nm -= sliding_rad * torque_Nm;
    out.unsure_Nm2 += unsure * unsure;
  }
  out.unsure_Nm2 *= kResting * kResting * mu * mu;
  return out;
}

// One equation of the Kalman filter: torque_Nm + per_mu_Nm (true mu - mu) = noise.
void learn(const AxisBalance& axis, double period_s, FrictionEstimatorState& state) noexcept {
  state.variance += kFrictionDrift_1_s * kFrictionDrift_1_s * period_s;
  const double from_mu = axis.per_mu_Nm * state.variance;
  const double variance_Nm2 = axis.per_mu_Nm * from_mu + kBalanceNoise_Nm * kBalanceNoise_Nm + axis.unsure_Nm2;
  const double limit_Nm = kInnovationLimit * std::sqrt(variance_Nm2);
  state.mu -= from_mu / variance_Nm2 * clamp(axis.torque_Nm, -limit_Nm, limit_Nm);
  state.variance -= from_mu * from_mu / variance_Nm2;
}

double band_about(double mu) noexcept { return kFrictionFlagShare * mu + kFrictionFlag; }

bool is_off(double declared_mu, const FrictionEstimatorState& state) noexcept {
  const double off = std::fabs(state.mu - declared_mu) - 2.0 * friction_sd(state);
  return off > (state.flagged ? 0.5 : 1.0) * band_about(declared_mu);
}

double max_planned(double declared_mu) noexcept { return larger(declared_mu, kFrictionPlanMost); }

}  // namespace

std::uint32_t turning_segments(const RobotParams& table, const ThetaVector& rate_rad_s) noexcept {
  std::uint32_t turning = 0;
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) {
    const double rate = std::fabs(rate_rad_s[2 * j]) + std::fabs(rate_rad_s[2 * j + 1]);
    if (rate > kSlidingRate_rad_s) turning |= 1u << j;
  }
  return turning;
}

void reset_friction_watch(double declared_mu, FrictionEstimatorState& state) noexcept {
  const double sd = kFrictionPrior + kFrictionPriorShare * declared_mu;
  state = FrictionEstimatorState{};
  state.mu = declared_mu;
  state.variance = sd * sd;
}

double friction_sd(const FrictionEstimatorState& state) noexcept {
  const double model = kFrictionModelShare * state.mu;
  return std::sqrt(state.variance + model * model);
}

bool watch_friction(const RobotParams& table, const CableLayout& layout, double declared_mu,
                    const FrictionReadings& now, FrictionEstimatorState& state) noexcept {
  const Index k = state.axis;
  const double period_s = kFrictionTicks * table.tick_s;
  AxisBalance axis = balance_about(layout, now, turning_segments(table, now.rate_rad_s), state.mu, k);
  axis.torque_Nm += now.load_Nm;
  if (now.moving && !feeds(table.segment[k / 2])) learn(axis, period_s, state);
  state.axis = k + 1 < static_cast<Index>(table.theta_count()) ? state.axis + 1 : 0;
  if (state.axis == 0) state.flagged = is_off(declared_mu, state);
  return state.axis == 0;
}

double plan_friction(double declared_mu, double planned_mu, double tick_s,
                     const FrictionEstimatorState& state) noexcept {
  const bool certain = state.variance < kFrictionPlanSd * kFrictionPlanSd;
  const double wanted_mu = state.flagged && certain ? clamp(state.mu, 0.0, max_planned(declared_mu)) : declared_mu;
  const double step = kFrictionPlanRate_1_s * tick_s;
  return planned_mu + clamp(wanted_mu - planned_mu, -step, step);
}

bool is_friction_too_high(double declared_mu, const FrictionEstimatorState& state) noexcept {
  const double most = max_planned(declared_mu);
  return state.flagged && state.mu - 2.0 * friction_sd(state) > most + band_about(most);
}

}  // namespace liana::cable
