#include "firmware_like/arm/estimator.hpp"

#include <cmath>

#include "firmware_like/arm/tension.hpp"
#include "firmware_like/math/cholesky.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana {

using Index = std::size_t;

ThetaVector least_squares_theta(const RobotTable& table, const CableGeometry& geometry, const CableVector& change_m) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  const Index cables = static_cast<Index>(table.cable_count());
  SquareMatrix<kMaxTheta> normal{};
  ThetaVector x{};
  for (Index c = 0; c < cables; ++c) {
    const auto& row = geometry.jacobian_m_rad[c];
    for (Index i = 0; i < n; ++i) {
      if (row[i] == 0.0) continue;
      x[i] += row[i] * change_m[c];
      for (Index k = 0; k <= i; ++k) normal[i][k] += row[i] * row[k];
    }
  }
  cholesky_solve(normal, x, n);
  return x;
}

void estimate(const RobotTable& table, const CableLayout& layout, const SlipState& slip, const CableVector& payout_m,
              const CableVector& tension_N, EstimatorState& state) noexcept {
  const Index cables = static_cast<Index>(table.cable_count());
  const double blend = state.primed ? table.tick_s / (kTensionFilter_s + table.tick_s) : 1.0;
  for (Index c = 0; c < cables; ++c) state.tension_N[c] += blend * (tension_N[c] - state.tension_N[c]);
  state.primed = true;

  const CableGeometry geometry = cable_geometry(table, layout, arm_trig(table, state.theta_rad));
  const TensionRatio ratio = tension_ratio(table, layout, geometry, slip);
  const CableVector expected_m = payout_for(table, layout, geometry, ratio, state.tension_N);
  for (Index c = 0; c < cables; ++c) state.residual_m[c] = payout_m[c] - expected_m[c];
  const ThetaVector step = least_squares_theta(table, geometry, state.residual_m);
  state.largest_step_rad = 0.0;
  for (Index i = 0; i < static_cast<Index>(table.theta_count()); ++i) {
    constexpr double kLargestStep_rad = 0.1;  // keeps the first steps from far away inside the geometry's range
    const double bounded = clamp(step[i], -kLargestStep_rad, kLargestStep_rad);
    state.theta_rad[i] += bounded;
    state.largest_step_rad = larger(state.largest_step_rad, std::fabs(bounded));
  }
}

}  // namespace liana
