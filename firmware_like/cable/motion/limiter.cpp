#include "firmware_like/cable/motion/limiter.hpp"

#include <cmath>

#include "firmware_like/math/braking.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/safety/limits.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

constexpr double kCableShare = 0.8;  // of the cable speed limit; the rest is for tension changes and damping

// Factor <= 1 that brings the fastest cable under `share` of the cable speed limit.
double cable_factor(const RobotParams& table, const CableGeometry& geometry, const ThetaVector& rate,
                    double share) noexcept {
  double fastest = 0.0;
  Index c = 0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    for (const Index end = c + static_cast<Index>(table.segment[m].cables); c < end; ++c) {
      fastest = larger(fastest, std::fabs(dot_pairs(geometry.jacobian_m_rad[c].data(), rate.data(), m + 1)));
    }
  }
  const double allowed = share * table.limits.cable_speed_m_s;
  return fastest > allowed ? allowed / fastest : 1.0;
}

// Factor <= 1 that brings the fastest joint under `allowed_rad_s`.
double rate_factor(const ThetaVector& rate, double allowed_rad_s) noexcept {
  double fastest = 0.0;
  for (const double one : rate) fastest = larger(fastest, std::fabs(one));
  return fastest > allowed_rad_s ? allowed_rad_s / fastest : 1.0;
}

}  // namespace

void reset_limiter(const ThetaVector& theta_rad, LimiterState& state) noexcept {
  state = LimiterState{};
  state.theta_rad = theta_rad;
  state.reference_rad = theta_rad;
}

StepShare allowed_share(const RobotParams& table, const CableGeometry& geometry, const ThetaVector& step_rad,
                        const GovernorState& governor, const LimiterState& state) noexcept {
  constexpr double kPathShare = 0.95;  // of speeds; the rest is for making up a lag
  const double change = table.limits.theta_accel_rad_s2 * table.tick_s;
  ThetaVector rate{};
  double fastest = 0.0, most = 1.0, least = 0.0;  // acceleration: least <= share <= most
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    rate[k] = step_rad[k] / table.tick_s;
    const double size = std::fabs(rate[k]);
    const double now = rate[k] < 0.0 ? -state.rate_rad_s[k] : state.rate_rad_s[k];
    fastest = larger(fastest, size);
    if (now + change < size) most = smaller(most, larger(0.0, now + change) / size);
    if (now - change > 0.0) least = larger(least, smaller(1.0, (now - change) / size));
  }
  const double allowed = kPathShare * table.limits.theta_rate_rad_s;
  const double by_rate = fastest > allowed ? allowed / fastest : 1.0;
  const double by_cable = cable_factor(table, geometry, rate, kPathShare * kCableShare);
  const LoadShares load = shares_in_room(table, rate, state.rate_rad_s, governor);
  const double by_accel = larger(smaller(most, load.most), larger(least, load.least));
  StepShare out{smaller(smaller(by_rate, by_cable), by_accel), 0};
  if (out.share == 1.0) return out;
  if (by_rate <= out.share) out.limits |= kLimitThetaRate;
  if (by_cable <= out.share) out.limits |= kLimitCableSpeed;
  if (by_accel <= out.share) out.limits |= kLimitThetaAccel;
  return out;
}

void limit_motion(const RobotParams& table, const CableGeometry& geometry, const ThetaVector& reference_rad,
                  LimiterState& state, bool judged, double rate_share) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  const double h = table.tick_s;
  const double accel = table.limits.theta_accel_rad_s2;
  ThetaVector wanted{};
  for (Index k = 0; k < n; ++k) {
    wanted[k] = wanted_rate(state.reference_rad[k] - state.theta_rad[k],
                            (reference_rad[k] - state.reference_rad[k]) / h, accel, h);
  }
  const bool follows = judged && state.reference_rad == state.theta_rad;
  double factor = follows ? 1.0 : cable_factor(table, geometry, wanted, kCableShare);
  state.limits = factor < 1.0 ? std::uint32_t{kLimitCableSpeed} : std::uint32_t{0};
  if (rate_share < 1.0) {
    const double by_rate = rate_factor(wanted, rate_share * table.limits.theta_rate_rad_s);
    if (by_rate < 1.0) state.limits |= kLimitThetaRate;
    factor = smaller(factor, by_rate);
  }
  for (Index k = 0; k < n; ++k) {
    const double rate = clamp(wanted[k] * factor, -table.limits.theta_rate_rad_s, table.limits.theta_rate_rad_s);
    if (rate != wanted[k] * factor) state.limits |= kLimitThetaRate;
    const double room = table.segment[k / 2].theta_limit_rad - (rate < 0.0 ? -state.theta_rad[k] : state.theta_rad[k]);
    const double stopping = rate_before_limit(rate, room, accel, h);
    if (stopping != rate) state.limits |= kLimitTheta;
    const double bounded = clamp(stopping, state.rate_rad_s[k] - accel * h, state.rate_rad_s[k] + accel * h);
    if (bounded != stopping) state.limits |= kLimitThetaAccel;
    if (bounded == wanted[k] && state.reference_rad[k] == state.theta_rad[k]) {
      state.theta_rad[k] = reference_rad[k];  // exactly, so that held variables stand still to the last bit
    } else {
      state.theta_rad[k] += bounded * h;
      if (std::fabs(reference_rad[k] - state.theta_rad[k]) < 1e-12) state.theta_rad[k] = reference_rad[k];
    }
    state.rate_rad_s[k] = bounded;
    state.reference_rad[k] = reference_rad[k];
  }
}

double largest_rate(const RobotParams& table, const LimiterState& state) noexcept {
  double largest = 0.0;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
    largest = larger(largest, std::fabs(state.rate_rad_s[k]));
  return largest;
}

}  // namespace liana::cable
