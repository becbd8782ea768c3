#include "firmware_like/cable/motion/damping.hpp"

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {

using Index = std::size_t;

void damp(const RobotParams& table, const CableGeometry& geometry, const CableSolver& solver,
          const CableVector& stretch_m, DampingState& state) noexcept {
  const ThetaVector deflection = solve_cables(table, geometry, solver, stretch_m).theta_rad;
  const double lead_s = table.servo_time_constant_s + kTensionFilter_s + table.tick_s;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    state.standing_rad[k] += table.tick_s / kDampingHighPass_s * (deflection[k] - state.standing_rad[k]);
    const double rate =
        kDampingRate_1_s * (deflection[k] - state.standing_rad[k]) - state.shift_rad[k] / kDampingLeak_s;
    state.shift_rad[k] += rate * table.tick_s;
    state.output_rad[k] = clamp(state.shift_rad[k] + lead_s * rate, -kDampingLimit_rad, kDampingLimit_rad);
  }
}

}  // namespace liana::cable
