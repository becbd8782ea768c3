#include "firmware_like/motion/damping.hpp"

#include "firmware_like/math/scalar.hpp"

namespace liana {

using Index = std::size_t;

void damp(const RobotTable& table, const CableLayout& layout, const CableSolver& solver, const CableVector& planned_m,
          const CableVector& measured_m, DampingState& state) noexcept {
  CableVector stretch_m;
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) stretch_m[c] = planned_m[c] - measured_m[c];
  const ThetaVector deflection = solve_cables(table, layout, solver, stretch_m);

  const double lead_s = table.servo_time_constant_s + kTensionFilter_s + table.tick_s;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    state.standing_rad[k] += table.tick_s / kDampingHighPass_s * (deflection[k] - state.standing_rad[k]);
    const double rate = kDampingRate_1_s * (deflection[k] - state.standing_rad[k]) - state.shift_rad[k] / kDampingLeak_s;
    state.shift_rad[k] += rate * table.tick_s;
    state.output_rad[k] = clamp(state.shift_rad[k] + lead_s * rate, -kDampingLimit_rad, kDampingLimit_rad);
  }
}

}  // namespace liana
