#include "firmware_like/cable/arm/body_inertia.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

using NodeVectors = std::array<Vec3, kMaxSegments + 1>;  // [0] = base

// What accelerates every node, from segment `first` on, so.
NodeVectors forces(const RobotParams& table, Index first, const NodeVectors& accel) noexcept {
  NodeVectors force{};
  for (Index j = first; j < static_cast<Index>(table.segment_count); ++j) {
    const double sixth_kg = table.segment[j].modules * table.segment[j].module_mass_kg / 6.0;
    force[j] = add(force[j], scale(add(scale(accel[j], 2.0), accel[j + 1]), sixth_kg));
    force[j + 1] = scale(add(accel[j], scale(accel[j + 1], 2.0)), sixth_kg);
  }
  const Index tip = static_cast<Index>(table.segment_count);
  if (table.tool.mass_kg > 0.0) force[tip] = add(force[tip], scale(accel[tip], table.tool.mass_kg));
  return force;
}

}  // namespace

void follow_acceleration(const RobotParams& table, const ThetaVector& theta_rad, const CableVector& tension_N,
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
  const Index cables = static_cast<Index>(table.cable_count());
  for (Index c = 0; c < cables; ++c) {
    state.slow_N[c] += share * (tension_N[c] - state.slow_N[c]);
    state.tension_N[c] += share * (state.slow_N[c] - state.tension_N[c]);
  }
}

void update_mass_matrix(const RobotParams& table, const ArmKinematics& kinematics, MassMatrix& mass) noexcept {
  const Index thetas = static_cast<Index>(table.theta_count()), segments = thetas / 2;
  std::array<NodeVectors, kMaxTheta> moves{};  // of every node when theta k turns by 1 rad
  for (Index k = 0; k < thetas; ++k) {
    for (Index i = k / 2 + 1; i <= segments; ++i)
      moves[k][i] = node_jacobian_column(kinematics, static_cast<std::int32_t>(i), static_cast<std::int32_t>(k));
    const NodeVectors force = forces(table, k / 2, moves[k]);
    for (Index l = 0; l <= k; ++l) {
      double torque_Nm = 0.0;
      for (Index i = k / 2; i <= segments; ++i) torque_Nm += dot(moves[l][i], force[i]);
      mass[k][l] = mass[l][k] = torque_Nm;
    }
  }
}

double inertia_torque_Nm(const RobotParams& table, const MassMatrix& mass, const ThetaVector& accel_rad_s2,
                         Index axis) noexcept {
  double torque_Nm = 0.0;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) torque_Nm += mass[axis][k] * accel_rad_s2[k];
  return torque_Nm;
}

}  // namespace liana::cable
