#include "tests/benchmarks/own_80.hpp"

#include <cmath>
#include <stdexcept>

#include "firmware_like/math/cholesky.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::bench {
namespace {

using Axes = std::array<Vec3, 3>;  // x, y, z of the turning frame in the base

Axes turned(const Axes& axes, bool is_pitch, const SinCos& t) {
  const Vec3& x = axes[0];
  const std::size_t other = is_pitch ? 1 : 2;
  const Vec3& w = axes[other];
  const double s = is_pitch ? t.sin : -t.sin;
  Axes out = axes;
  out[0] = add(scale(x, t.cos), scale(w, s));
  out[other] = subtract(scale(w, t.cos), scale(x, s));
  return out;
}

// Unit quaternion of three axes whose turn is less than half (the arm's own limits keep it so in the bench's targets).
Quat quaternion_of_axes(const Axes& axes) {
  const double trace = axes[0][0] + axes[1][1] + axes[2][2];
  if (trace > 0.0) {
    const double w = 0.5 * std::sqrt(1.0 + trace);
    return {w, (axes[1][2] - axes[2][1]) / (4.0 * w), (axes[2][0] - axes[0][2]) / (4.0 * w),
            (axes[0][1] - axes[1][0]) / (4.0 * w)};
  }
  std::size_t i = axes[0][0] > axes[1][1] ? 0 : 1;
  if (axes[2][2] > axes[i][i]) i = 2;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const double root = std::sqrt(1.0 + axes[i][i] - axes[j][j] - axes[k][k]);
  Quat q{};
  q[0] = (axes[j][k] - axes[k][j]) / (2.0 * root);
  q[1 + i] = 0.5 * root;
  q[1 + j] = (axes[j][i] + axes[i][j]) / (2.0 * root);
  q[1 + k] = (axes[k][i] + axes[i][k]) / (2.0 * root);
  return q;
}

// Walks the chain; `trig_of(i)` gives sine and cosine of hinge i. Columns first hold the hinge's point, then its linear
// velocity.
template <class TrigOf>
HingeKinematics walk(const HingeChain& chain, TrigOf&& trig_of) {
  HingeKinematics out;
  Axes axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  Vec3 point{};
  for (std::size_t i = 0; i < kHinges; ++i) {
    const Hinge& hinge = chain[i];
    out.linear[i] = point;
    out.angular[i] = axes[hinge.is_pitch ? 2 : 1];
    axes = turned(axes, hinge.is_pitch, trig_of(i));
    if (hinge.link_m > 0.0) point = add(point, scale(axes[0], hinge.link_m));
  }
  for (std::size_t i = 0; i < kHinges; ++i) out.linear[i] = cross(out.angular[i], subtract(point, out.linear[i]));
  out.tip_in_base = {point, quaternion_of_axes(axes)};
  return out;
}

}  // namespace

HingeChain hinge_chain(const cable::RobotParams& table) {
  HingeChain chain;
  std::size_t i = 0;
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const cable::SegmentParams& segment = table.segment[static_cast<std::size_t>(m)];
    if (table.segment_count != 5 || segment.modules != 8)
      throw std::runtime_error("bench: the 80-hinge chain wants 5 segments of 8 modules");
    for (std::int32_t k = 0; k < segment.modules; ++k) {
      for (std::int32_t turn = 0; turn < 2; ++turn, ++i) {
        chain[i].is_pitch = (turn == 0) == (k % 2 == 0);
        chain[i].theta = static_cast<std::size_t>(2 * m + (chain[i].is_pitch ? 0 : 1));
        chain[i].link_m = turn == 1 ? segment.module_length_m : 0.0;
      }
    }
  }
  return chain;
}

HingeVector hinge_angles(const HingeChain& chain, const cable::ThetaVector& theta_rad) {
  HingeVector angle{};
  for (std::size_t i = 0; i < kHinges; ++i) angle[i] = theta_rad[chain[i].theta];
  return angle;
}

HingeKinematics hinge_kinematics(const HingeChain& chain, const HingeVector& angle_rad) {
  return walk(chain, [&](std::size_t i) { return sin_cos(angle_rad[i]); });
}

cable::ArmKinematics hinge_kinematics_summed(const cable::RobotParams& table, const HingeChain& chain,
                                             const cable::ThetaVector& theta_rad) {
  std::array<SinCos, cable::kMaxTheta> trig{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k) trig[k] = sin_cos(theta_rad[k]);
  const HingeKinematics full = walk(chain, [&](std::size_t i) { return trig[chain[i].theta]; });
  cable::ArmKinematics out;
  out.tip_in_base = full.tip_in_base;
  for (std::size_t i = 0; i < kHinges; ++i) {
    const std::size_t k = chain[i].theta;
    out.tip_jacobian.linear[k] = add(out.tip_jacobian.linear[k], full.linear[i]);
    out.tip_jacobian.angular[k] = add(out.tip_jacobian.angular[k], full.angular[i]);
  }
  return out;
}

void hinge_ik_step(const HingeKinematics& arm, std::array<double, 6> e, double damping, HingeVector& angle_rad) {
  std::array<std::array<double, kHinges>, 6> J;
  for (std::size_t i = 0; i < kHinges; ++i) {
    for (std::size_t r = 0; r < 3; ++r) {
      J[r][i] = arm.linear[i][r];
      J[r + 3][i] = arm.angular[i][r];
    }
  }
  SquareMatrix<6> A{};
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t s = 0; s <= r; ++s) {
      for (std::size_t i = 0; i < kHinges; ++i) A[r][s] += J[r][i] * J[s][i];
    }
    A[r][r] += damping;
  }
  if (!cholesky_factor(A)) return;
  cholesky_solve(A, e);
  for (std::size_t i = 0; i < kHinges; ++i) {
    for (std::size_t r = 0; r < 6; ++r) angle_rad[i] += J[r][i] * e[r];
  }
}

}  // namespace liana::bench
