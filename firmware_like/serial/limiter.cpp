#include "firmware_like/serial/limiter.hpp"

#include <cmath>

#include "firmware_like/math/braking.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/safety/limits.hpp"

namespace liana::serial {
namespace {

using Index = std::size_t;

// The rate of one joint that ranges, rates and accelerations let pass; says what acted.
double bounded_rate(const JointParams& joint, double tick_s, double wanted_rad_s, double now_rad, double now_rad_s,
                    std::uint32_t& limits) noexcept {
  const double change = joint.accel_rad_s2 * tick_s;
  const double rate = clamp(wanted_rad_s, -joint.rate_rad_s, joint.rate_rad_s);
  const double room = rate < 0.0 ? now_rad - joint.low_rad : joint.high_rad - now_rad;
  const double stopping = rate_before_limit(rate, room, joint.accel_rad_s2, tick_s);
  const double bounded = clamp(stopping, now_rad_s - change, now_rad_s + change);
  if (rate != wanted_rad_s) limits |= kLimitThetaRate;
  if (stopping != rate) limits |= kLimitTheta;
  if (bounded != stopping) limits |= kLimitThetaAccel;
  return bounded;
}

// Rate at which joint `i` goes after its reference.
double wanted_joint_rate(const RobotParams& table, const JointVector& reference_rad, Index i,
                         const LimiterState& state) noexcept {
  const double h = table.tick_s;
  return wanted_rate(state.reference_rad[i] - state.joint_rad[i], (reference_rad[i] - state.reference_rad[i]) / h,
                     table.joint[i].accel_rad_s2, h);
}

// Factor <= 1 that brings every joint under `share` of its rate limit.
double rate_factor(const RobotParams& table, const JointVector& reference_rad, double share,
                   const LimiterState& state) noexcept {
  double factor = 1.0;
  for (Index i = 0; i < table.joints(); ++i) {
    const double size = std::fabs(wanted_joint_rate(table, reference_rad, i, state));
    const double allowed = share * table.joint[i].rate_rad_s;
    if (size > allowed) factor = smaller(factor, allowed / size);
  }
  return factor;
}

}  // namespace

void reset_limiter(const JointVector& joint_rad, LimiterState& state) noexcept {
  state = LimiterState{};
  state.joint_rad = joint_rad;
  state.reference_rad = joint_rad;
}

StepShare allowed_share(const RobotParams& table, const JointVector& step_rad, const LimiterState& state) noexcept {
  constexpr double kPathShare = 0.95;             // of rates; the rest is for making up a lag
  double by_rate = 1.0, most = 1.0, least = 0.0;  // acceleration: least <= share <= most
  for (Index i = 0; i < table.joints(); ++i) {
    const JointParams& joint = table.joint[i];
    const double change = joint.accel_rad_s2 * table.tick_s;
    const double rate = step_rad[i] / table.tick_s, size = std::fabs(rate);
    const double now = rate < 0.0 ? -state.rate_rad_s[i] : state.rate_rad_s[i];
    if (size > kPathShare * joint.rate_rad_s) by_rate = smaller(by_rate, kPathShare * joint.rate_rad_s / size);
    if (now + change < size) most = smaller(most, larger(0.0, now + change) / size);
    if (now - change > 0.0) least = larger(least, smaller(1.0, (now - change) / size));
  }
  const double by_accel = larger(most, least);
  StepShare out{smaller(by_rate, by_accel), 0};
  if (out.share == 1.0) return out;
  if (by_rate <= out.share) out.limits |= kLimitThetaRate;
  if (by_accel <= out.share) out.limits |= kLimitThetaAccel;
  return out;
}

void limit_motion(const RobotParams& table, const JointVector& reference_rad, LimiterState& state,
                  double rate_share) noexcept {
  const double h = table.tick_s;
  const double factor = rate_share < 1.0 ? rate_factor(table, reference_rad, rate_share, state) : 1.0;
  state.limits = factor < 1.0 ? std::uint32_t{kLimitThetaRate} : std::uint32_t{0};
  for (Index i = 0; i < table.joints(); ++i) {
    const JointParams& joint = table.joint[i];
    const double gap_rad = state.reference_rad[i] - state.joint_rad[i];
    const double wanted = factor * wanted_joint_rate(table, reference_rad, i, state);
    const double rate = bounded_rate(joint, h, wanted, state.joint_rad[i], state.rate_rad_s[i], state.limits);
    if (rate == wanted && gap_rad == 0.0 && factor == 1.0) {
      state.joint_rad[i] = reference_rad[i];  // exactly, so that nothing creeps by roundings
    } else {
      state.joint_rad[i] += rate * h;
      if (std::fabs(reference_rad[i] - state.joint_rad[i]) < 1e-12) state.joint_rad[i] = reference_rad[i];
    }
    state.rate_rad_s[i] = rate;
    state.reference_rad[i] = reference_rad[i];
  }
}

JointVector braked_joints(const RobotParams& table, const LimiterState& state) noexcept {
  double part = 1.0;  // of its rate that every joint loses
  for (Index i = 0; i < table.joints(); ++i) {
    const double size = std::fabs(state.rate_rad_s[i]), change = table.joint[i].accel_rad_s2 * table.tick_s;
    if (size > change) part = smaller(part, change / size);
  }
  JointVector next{};
  for (Index i = 0; i < table.joints(); ++i) {
    next[i] = state.joint_rad[i] + (1.0 - part) * state.rate_rad_s[i] * table.tick_s;
  }
  return next;
}

double largest_rate(const RobotParams& table, const LimiterState& state) noexcept {
  double largest = 0.0;
  for (Index i = 0; i < table.joints(); ++i) largest = larger(largest, std::fabs(state.rate_rad_s[i]));
  return largest;
}

}  // namespace liana::serial
