#include "firmware_like/cable/arm/estimator.hpp"

#include <cmath>

#include "firmware_like/cable/arm/tension.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {

using Index = std::size_t;

void estimate(const RobotParams& table, const CableLayout& layout, const CableModel& model, const TensionRatio& ratio,
              const CableVector& payout_m, const CableVector& tension_N, EstimatorState& state) noexcept {
  const Index cables = static_cast<Index>(layout.cable_count);
  const double blend = state.primed ? table.tick_s / (kTensionFilter_s + table.tick_s) : 1.0;
  for (Index c = 0; c < cables; c += 2) {
    const Pair before_N = load_pair(&state.tension_N[c]);
    store_pair(before_N + blend * (load_pair(&tension_N[c]) - before_N), &state.tension_N[c]);
  }
  state.primed = true;

  CableVector change_m = payout_for(table, layout, model.geometry.part_m, ratio, state.tension_N);
  for (Index c = 0; c < cables; c += 2) store_pair(load_pair(&payout_m[c]) - load_pair(&change_m[c]), &change_m[c]);
  const CableSolution found = solve_cables(table, model.geometry, model.solver, change_m);
  state.residual_m = found.left_m;
  state.largest_step_rad = 0.0;
  for (Index i = 0; i < static_cast<Index>(table.theta_count()); ++i) {
    constexpr double kLargestStep_rad = 0.1;  // keeps the first steps from far away inside the geometry's range
    const double step =
        clamp(model.theta_rad[i] + found.theta_rad[i] - state.theta_rad[i], -kLargestStep_rad, kLargestStep_rad);
    state.theta_rad[i] += step;
    state.largest_step_rad = larger(state.largest_step_rad, std::fabs(step));
  }
}

}  // namespace liana::cable
