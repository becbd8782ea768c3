#include "firmware_like/cable/arm/contact_watch.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

Index segments(const RobotTable& table) noexcept { return static_cast<Index>(table.segment_count); }

// What is not contact may turn each angle by so much.
ThetaVector hidden_Nm(const RobotTable& table, const ContactWatchLimits& limits, const FrictionWatchState& friction,
                      double stir) noexcept {
  ThetaVector hidden{};
  for (Index k = 0; k < 2 * segments(table); ++k) {
    hidden[k] = limits.hidden_Nm[k / 2] + kContactInertia * limits.inertia[k / 2] * stir +
                kContactFriction * friction.friction_Nm[k];
  }
  return hidden;
}

// How hard the arm is accelerated, or was a moment ago.
void stir(const RobotTable& table, const ContactWatchLimits& limits, const ThetaVector& rate_rad_s,
          ContactWatchState& state) noexcept {
  const double round_s = kFrictionTicks * table.tick_s * table.theta_count();
  double now = 0.0;
  for (Index k = 0; k < 2 * segments(table); ++k)
    now += limits.inertia[k / 2] * std::fabs(rate_rad_s[k] - state.rate_rad_s[k]) / round_s;
  state.rate_rad_s = rate_rad_s;
  state.stir = larger(now, state.stir * (1.0 - round_s / kContactCalm_s));
}

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) noexcept { return dot(a, cross(b, c)); }

// The push at the tip that explains the torques best, each weighed by what may be hidden in it; small where it cannot
// be seen (a straight arm does not feel a push along itself).
Vec3 tip_push_N(const RobotTable& table, const Jacobian& tip, const ThetaVector& hidden,
                const FrictionWatchState& friction) noexcept {
  constexpr double kPrior = 1.0 / (kContactTip_N * kContactTip_N);
  Vec3 a{kPrior, 0.0, 0.0}, b{0.0, kPrior, 0.0}, c{0.0, 0.0, kPrior}, right{};
  for (Index k = 0; k < 2 * segments(table); ++k) {
    const double weight = 1.0 / (hidden[k] * hidden[k]);
    const Vec3& row = tip.linear[k];
    const Vec3 weighed = scale(row, weight);
    a = add(a, scale(row, weighed[0]));
    b = add(b, scale(row, weighed[1]));
    c = add(c, scale(row, weighed[2]));
    right = add(right, scale(weighed, friction.unexplained_Nm[k]));
  }
  const double inverse = 1.0 / determinant(a, b, c);  // at least the prior's
  return {determinant(right, b, c) * inverse, determinant(a, right, c) * inverse, determinant(a, b, right) * inverse};
}

}  // namespace

ContactWatchLimits make_contact_watch_limits(const RobotTable& table) noexcept {
  ContactWatchLimits limits;
  double reach_m = 0.0, mass_kg = 0.0, inertia_kg_m2 = 0.0;  // of the straight arm beyond a segment's root
  for (Index j = segments(table); j-- > 0;) {
    const SegmentTable& segment = table.segment[j];
    for (std::int32_t i = 0; i < segment.modules; ++i) {
      // Everything so far moves one link outwards; the new link's mass is at its end.
      inertia_kg_m2 += segment.module_length_m * (2.0 * reach_m + segment.module_length_m * mass_kg);
      reach_m += segment.module_length_m * mass_kg;
      mass_kg += segment.module_mass_kg;
      reach_m += segment.module_length_m * segment.module_mass_kg;
      inertia_kg_m2 += segment.module_length_m * segment.module_length_m * segment.module_mass_kg;
    }
    limits.inertia[j] = segment.modules * std::sqrt(inertia_kg_m2);
    limits.hidden_Nm[j] = kContactTorque_Nm + kContactSwing_rad_s2 * segment.modules * inertia_kg_m2;
  }
  return limits;
}

void watch_contact(const RobotTable& table, const ContactWatchLimits& limits, const ArmKinematics& kinematics,
                   const ThetaVector& rate_rad_s, const FrictionWatchState& friction,
                   ContactWatchState& state) noexcept {
  const Jacobian& tip = kinematics.tip_jacobian;
  stir(table, limits, rate_rad_s, state);
  const ThetaVector hidden = hidden_Nm(table, limits, friction, state.stir);
  state.tip_push_N = tip_push_N(table, tip, hidden, friction);
  const double push_N = norm(state.tip_push_N);
  const Vec3 explained_N = push_N > kContactTip_N ? scale(state.tip_push_N, kContactTip_N / push_N) : state.tip_push_N;
  // What is felt is judged without the push at the tip, which segments feel it with it: beyond a contact there is no
  // torque, while a push at the tip that explains half of it is felt by all.
  bool is_felt = false;
  std::int32_t last = 0;
  state.torque_Nm = 0.0;
  for (Index k = 0; k < 2 * segments(table); ++k) {
    const double whole_Nm = friction.unexplained_Nm[k];
    const double left_Nm = std::fabs(whole_Nm - dot(tip.linear[k], explained_N));
    is_felt = is_felt || left_Nm > hidden[k];
    if (std::fabs(whole_Nm) > hidden[k]) last = static_cast<std::int32_t>(k / 2);
    state.torque_Nm = larger(state.torque_Nm, left_Nm);
  }
  const std::int32_t segment = is_felt ? last : -1;
  if (segment >= 0 && is_in_contact(state)) return;  // the segment that was named first stays
  state.sweeps = segment < 0 ? 0 : static_cast<std::uint8_t>(state.sweeps + 1);
  state.segment = segment;
}

}  // namespace liana::cable
