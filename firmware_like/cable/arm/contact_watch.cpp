#include "firmware_like/cable/arm/contact_watch.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

Index segments(const RobotTable& table) noexcept { return static_cast<Index>(table.segment_count); }

double hidden_Nm(const ContactWatchLimits& limits, const FrictionWatchState& friction, Index k) noexcept {
  return limits.hidden_Nm[k / 2] + kContactFriction * friction.friction_Nm[k];
}

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) noexcept { return dot(a, cross(b, c)); }

// The push at the tip that explains the torques best, each weighed by what may be hidden in it; small where it cannot
// be seen (a straight arm does not feel a push along itself).
Vec3 tip_push_N(const RobotTable& table, const ContactWatchLimits& limits, const Jacobian& tip,
                const FrictionWatchState& friction) noexcept {
  constexpr double kPrior = 1.0 / (kContactTip_N * kContactTip_N);
  Vec3 a{kPrior, 0.0, 0.0}, b{0.0, kPrior, 0.0}, c{0.0, 0.0, kPrior}, right{};
  for (Index k = 0; k < 2 * segments(table); ++k) {
    const double hidden = hidden_Nm(limits, friction, k), weight = 1.0 / (hidden * hidden);
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
    limits.hidden_Nm[j] = kContactTorque_Nm + kContactSwing_rad_s2 * segment.modules * inertia_kg_m2;
  }
  return limits;
}

void watch_contact(const RobotTable& table, const ContactWatchLimits& limits, const ArmKinematics& kinematics,
                   const FrictionWatchState& friction, ContactWatchState& state) noexcept {
  const Jacobian& tip = kinematics.tip_jacobian;
  state.tip_push_N = tip_push_N(table, limits, tip, friction);
  const double push_N = norm(state.tip_push_N);
  const Vec3 explained_N = push_N > kContactTip_N ? scale(state.tip_push_N, kContactTip_N / push_N) : state.tip_push_N;
  // What is felt is judged without the push at the tip, which segments feel it with it: beyond a contact there is no
  // torque, while a push at the tip that explains half of it is felt by all.
  bool is_felt = false;
  std::int32_t last = 0;
  state.torque_Nm = 0.0;
  for (Index k = 0; k < 2 * segments(table); ++k) {
    const double whole_Nm = friction.unexplained_Nm[k], hidden = hidden_Nm(limits, friction, k);
    const double left_Nm = std::fabs(whole_Nm - dot(tip.linear[k], explained_N));
    is_felt = is_felt || left_Nm > hidden;
    if (std::fabs(whole_Nm) > hidden) last = static_cast<std::int32_t>(k / 2);
    state.torque_Nm = larger(state.torque_Nm, left_Nm);
  }
  const std::int32_t segment = is_felt ? last : -1;
  if (segment >= 0 && is_in_contact(state)) return;  // the segment that was named first stays
  state.sweeps = segment < 0 ? 0 : static_cast<std::uint8_t>(state.sweeps + 1);
  state.segment = segment;
}

}  // namespace liana::cable
