#include "firmware_like/motion/servo_ik.hpp"

#include <cmath>

#include "firmware_like/math/cholesky.hpp"

namespace liana {
namespace {

using Index = std::size_t;
using Task = std::array<double, 6>;

bool is_set(std::uint32_t mask, Index i) noexcept { return ((mask >> i) & 1u) != 0; }

double column(const Jacobian& J, Index row, Index k) noexcept { return row < 3 ? J.linear[k][row] : J.angular[k][row - 3]; }

// dtheta = J^T (J J^T + damping I)^-1 e over the thetas that `fixed` leaves free.
ThetaVector damped_step(const Jacobian& J, Index n, std::uint32_t fixed, const Task& e, double damping) noexcept {
  SquareMatrix<6> A{};
  Task y = e;
  for (Index r = 0; r < 6; ++r) {
    for (Index s = 0; s <= r; ++s) {
      double sum = 0.0;
      for (Index k = 0; k < n; ++k) {
        if (!is_set(fixed, k)) sum += column(J, r, k) * column(J, s, k);
      }
      A[r][s] = sum;
    }
    A[r][r] += damping;
  }
  ThetaVector step{};
  if (!cholesky_solve(A, y, 6)) return step;
  for (Index k = 0; k < n; ++k) {
    if (is_set(fixed, k)) continue;
    for (Index r = 0; r < 6; ++r) step[k] += column(J, r, k) * y[r];
  }
  return step;
}

double limit_of(const RobotTable& table, Index theta) noexcept { return table.segment[theta / 2].theta_limit_rad; }

// Sets thetas that the step would carry over their limit onto it; returns those newly fixed and takes their share from e.
std::uint32_t clip_to_limits(const RobotTable& table, const Jacobian& J, Index n, std::uint32_t fixed, ThetaVector& theta,
                             ThetaVector& step, Task& e) noexcept {
  std::uint32_t clipped = 0;
  for (Index k = 0; k < n; ++k) {
    if (is_set(fixed, k)) continue;
    const double limit = limit_of(table, k);
    const double wanted = theta[k] + step[k];
    if (wanted <= limit && wanted >= -limit) continue;
    const double bound = wanted > limit ? limit : -limit;
    const double moved = bound - theta[k];
    clipped |= 1u << k;
    theta[k] = bound;  // theta + moved may be a rounding beyond it
    for (Index r = 0; r < 6; ++r) e[r] -= column(J, r, k) * moved;
  }
  return clipped;
}

}  // namespace

std::array<double, 6> pose_error(const Pose& goal, const Pose& tip) noexcept {
  const Vec3 p = subtract(goal.position_m, tip.position_m);
  const Vec3 r = rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion)));
  return {p[0], p[1], p[2], r[0], r[1], r[2]};
}

IkReport ik_step(const RobotTable& table, const IkGoal& goal, double damping, ThetaVector& theta_rad) noexcept {
  const Index n = static_cast<Index>(table.theta_count());
  const ArmKinematics arm = forward_kinematics(table, theta_rad);
  Task e = pose_error(goal.tip_in_base, arm.tip_in_base);
  IkReport report;
  report.position_error_m = std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
  report.attitude_error_rad = std::sqrt(e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  std::uint32_t fixed = goal.held_mask;
  ThetaVector step{};
  for (std::int32_t pass = 0; pass < kLimitPasses; ++pass) {
    step = damped_step(arm.tip_jacobian, n, fixed, e, damping);
    const std::uint32_t clipped = clip_to_limits(table, arm.tip_jacobian, n, fixed, theta_rad, step, e);
    if (clipped == 0) break;
    report.at_limit = true;
    fixed |= clipped;
    if (pass + 1 == kLimitPasses) step = ThetaVector{};  // too many at once: the rest waits for the next tick
  }
  double left2 = 0.0, asked2 = 0.0;
  for (Index r = 0; r < 6; ++r) {
    double reached = 0.0;
    for (Index k = 0; k < n; ++k) reached += is_set(fixed, k) ? 0.0 : column(arm.tip_jacobian, r, k) * step[k];
    left2 += (e[r] - reached) * (e[r] - reached);
    asked2 += e[r] * e[r];
  }
  report.singular = left2 > 0.25 * asked2 && asked2 > 1e-12;
  for (Index k = 0; k < n; ++k) {
    if (!is_set(fixed, k)) theta_rad[k] += step[k];
  }
  return report;
}

}  // namespace liana
