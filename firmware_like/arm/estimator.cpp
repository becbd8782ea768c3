#include "firmware_like/arm/estimator.hpp"

#include <cmath>

#include "firmware_like/arm/tension.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana {

using Index = std::size_t;

namespace {

// J^T J by 2 x 2 blocks, lower triangle: segments a >= b, summed over the cables that pass a.
void add_block(const CableLayout& layout, const CableGeometry& geometry, Index first_cable, Index a, Index b,
               SquareMatrix<kMaxTheta>& normal) noexcept {
  Pair pitch{}, yaw{};  // rows of the block
  for (Index c = first_cable; c < static_cast<Index>(layout.cable_count); ++c) {
    const double* const row = geometry.jacobian_m_rad[c].data();
    const Pair by_b = load_pair(row + 2 * b);
    pitch += both(row[2 * a]) * by_b;
    yaw += both(row[2 * a + 1]) * by_b;
  }
  store_pair(pitch, &normal[2 * a][2 * b]);
  store_pair(yaw, &normal[2 * a + 1][2 * b]);
}

}  // namespace

void update_cable_solver(const RobotTable& table, const CableLayout& layout, const ArmTrig& trig, CableSolver& solver) noexcept {
  update_cable_geometry(table, layout, trig, solver.geometry);
  Index first_cable = 0;
  for (Index a = 0; a < static_cast<Index>(table.segment_count); ++a) {
    for (Index b = 0; b <= a; ++b) add_block(layout, solver.geometry, first_cable, a, b, solver.factor);
    first_cable += static_cast<Index>(table.segment[a].cables);
  }
  solver.regular = cholesky_factor(solver.factor, static_cast<Index>(table.theta_count()));
}

ThetaVector solve_cables(const RobotTable& table, const CableLayout& layout, const CableSolver& solver,
                         const CableVector& change_m) noexcept {
  ThetaVector x{};
  if (!solver.regular) return x;
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    const double* const row = solver.geometry.jacobian_m_rad[c].data();
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j) {
      store_pair(load_pair(&x[2 * j]) + both(change_m[c]) * load_pair(row + 2 * j), &x[2 * j]);
    }
  }
  cholesky_solve(solver.factor, x, static_cast<Index>(table.theta_count()));
  return x;
}

void estimate(const RobotTable& table, const CableLayout& layout, const TensionRatio& ratio, const CableVector& payout_m,
              const CableVector& tension_N, EstimatorState& state) noexcept {
  const Index cables = static_cast<Index>(layout.cable_count);
  const double blend = state.primed ? table.tick_s / (kTensionFilter_s + table.tick_s) : 1.0;
  for (Index c = 0; c < cables; ++c) state.tension_N[c] += blend * (tension_N[c] - state.tension_N[c]);
  state.primed = true;

  update_cable_solver(table, layout, arm_trig(table, state.theta_rad), state.solver);
  const CableVector expected_m = payout_for(table, layout, state.solver.geometry, ratio, state.tension_N);
  for (Index c = 0; c < cables; ++c) state.residual_m[c] = payout_m[c] - expected_m[c];
  const ThetaVector step = solve_cables(table, layout, state.solver, state.residual_m);
  state.largest_step_rad = 0.0;
  for (Index i = 0; i < static_cast<Index>(table.theta_count()); ++i) {
    constexpr double kLargestStep_rad = 0.1;  // keeps the first steps from far away inside the geometry's range
    const double bounded = clamp(step[i], -kLargestStep_rad, kLargestStep_rad);
    state.theta_rad[i] += bounded;
    state.largest_step_rad = larger(state.largest_step_rad, std::fabs(bounded));
  }
}

}  // namespace liana
