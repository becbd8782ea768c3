#include "firmware_like/cable/arm/body_inertia.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

double half_mass_kg(const SegmentTable& segment) noexcept { return 0.5 * segment.modules * segment.module_mass_kg; }

// Half of the segment before the node, and of the one after it.
double node_mass_kg(const RobotTable& table, Index segment) noexcept {
  const bool is_last = segment + 1 == static_cast<Index>(table.segment_count);
  return half_mass_kg(table.segment[segment]) + (is_last ? 0.0 : half_mass_kg(table.segment[segment + 1]));
}

}  // namespace

void follow_acceleration(const RobotTable& table, const ThetaVector& theta_rad, const CableVector& tension_N,
                         double period_s, BodyInertiaState& state) noexcept {
  if (!state.begun) {
    state.slow_rad = theta_rad;
    state.slow_N = state.tension_N = tension_N;
  }
  state.begun = true;
  const double share = period_s / (kAccelerationFilter_s + period_s);
  constexpr double kPerSecond = 1.0 / kAccelerationFilter_s;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    state.slow_rad[k] += share * (theta_rad[k] - state.slow_rad[k]);
    const double rate_rad_s = kPerSecond * (theta_rad[k] - state.slow_rad[k]);
    state.slow_rad_s[k] += share * (rate_rad_s - state.slow_rad_s[k]);
    state.accel_rad_s2[k] = kPerSecond * (rate_rad_s - state.slow_rad_s[k]);
  }
  for (Index c = 0; c < static_cast<Index>(table.cable_count()); ++c) {
    state.slow_N[c] += share * (tension_N[c] - state.slow_N[c]);
    state.tension_N[c] += share * (state.slow_N[c] - state.tension_N[c]);
  }
}

void feel_inertia(const RobotTable& table, const ArmKinematics& kinematics, BodyInertiaState& state) noexcept {
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) {
    Vec3 accel_m_s2{};
    const auto node = static_cast<std::int32_t>(j + 1);
    for (std::int32_t k = 0; k < 2 * node; ++k) {
      const double angle_rad_s2 = state.accel_rad_s2[static_cast<Index>(k)];
      accel_m_s2 = add(accel_m_s2, scale(node_jacobian_column(kinematics, node, k), angle_rad_s2));
    }
    state.force_N[j] = scale(accel_m_s2, node_mass_kg(table, j));
  }
}

double inertia_torque_Nm(const RobotTable& table, const ArmKinematics& kinematics, const BodyInertiaState& state,
                         Index axis) noexcept {
  double torque_Nm = 0.0;
  for (Index j = axis / 2; j < static_cast<Index>(table.segment_count); ++j) {
    const Vec3 column =
        node_jacobian_column(kinematics, static_cast<std::int32_t>(j + 1), static_cast<std::int32_t>(axis));
    torque_Nm += dot(column, state.force_N[j]);
  }
  return torque_Nm;
}

}  // namespace liana::cable
