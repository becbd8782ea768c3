#include "firmware_like/cable/arm/tension.hpp"

#include <cmath>

#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;
using AnchoredVector = std::array<double, kMaxSegmentCables>;  // one number per cable of a segment

// Smooth maximum of two numbers: exact far apart, rounded over `width` [N] near equality.
double smooth_maximum(double a, double b, double width) noexcept {
  const double d = a - b;
  return 0.5 * (a + b + std::sqrt(d * d + width * width));
}

void complete(Index n, SegmentBalance& b) noexcept {
  for (Index i = 0; i < n; ++i) {
    b.pp += b.p[i] * b.p[i];
    b.pq += b.p[i] * b.q[i];
    b.qq += b.q[i] * b.q[i];
  }
  b.det = b.pp * b.qq - b.pq * b.pq;
}

bool is_solvable(const SegmentBalance& b) noexcept { return b.det > 1e-12 * b.pp * b.qq; }

// Least-norm solution.
AnchoredVector solve(const SegmentBalance& b, Index n, double rhs_p, double rhs_q) noexcept {
  const double u = (rhs_p * b.qq - rhs_q * b.pq) / b.det;
  const double w = (rhs_q * b.pp - rhs_p * b.pq) / b.det;
  AnchoredVector x{};
  for (Index i = 0; i < n; ++i) x[i] = b.p[i] * u + b.q[i] * w;
  return x;
}

// Projection of (1, ..., 1) on the null space: pulling all cables of the segment harder without turning it.
AnchoredVector pull_together(const SegmentBalance& b, Index n) noexcept {
  double sum_p = 0.0, sum_q = 0.0;
  for (Index i = 0; i < n; ++i) sum_p += b.p[i], sum_q += b.q[i];
  AnchoredVector x = solve(b, n, sum_p, sum_q);
  for (Index i = 0; i < n; ++i) x[i] = 1.0 - x[i];
  return x;
}

constexpr double kSmoothWidth_N = 2.0;  // over which floor, margin and ceiling take force

// Shifts s such that t + s null keeps every cable of a segment on the right side, smooth.
struct Shifts {
  double wanted = 0.0;  // least s >= 0 over the floor and its margin
  double least = 0.0;   // least s >= 0 over the floor
  double most = 1e3;    // largest s under the ceiling
};

Shifts shifts_for(const AnchoredVector& t, const AnchoredVector& null, const double* pull_N, Index n,
                  const TensionLimits& limits, double margin_N, double width_N) noexcept {
  Shifts s;
  for (Index i = 0; i < n; ++i) {
    if (!(null[i] > 0.05)) continue;
    const double per_N = 1.0 / null[i], to_floor = (limits.floor_motor_N + width_N - t[i]) * per_N;
    s.wanted = smooth_maximum(s.wanted, to_floor + margin_N * per_N, width_N);
    s.least = smooth_maximum(s.least, to_floor, width_N);
    const double ceiling_N = smaller(kLoadCeilingShare * limits.ceiling_free_N,
                                     kCeilingShare * limits.ceiling_free_N + kLoadLift * std::fabs(pull_N[i]));
    s.most = -smooth_maximum(-s.most, (t[i] - ceiling_N) * per_N, width_N);
  }
  return s;
}

// What the cables from `first` on, those of later segments, turn segment j's angles by.
std::array<double, 2> torque_beyond(const RobotParams& table, const TensionSolver& solver, const CableVector& tension_N,
                                    Index first, Index j) noexcept {
  const Index cables = static_cast<Index>(table.cable_count());
  Pair torque{};
  for (Index c = first; c < cables; ++c) torque += load_pair(&solver.pull_m[c][2 * j]) * tension_N[c];
  return {torque[0], torque[1]};
}

// What is pulled beyond the plan grows with what is missing, and is let go again.
double one_tick_tighter(const RobotParams& table, double pulled_N, double rise_N_s, double leak_s,
                        double limit_N) noexcept {
  return smaller(pulled_N + (rise_N_s - pulled_N / leak_s) * table.tick_s, limit_N);
}

double spread_of(const AnchoredVector& t, const CableVector& pull_N, Index first, Index n) noexcept {
  double least = t[0] - pull_N[first], most = least;
  for (Index i = 1; i < n; ++i) {
    least = smaller(least, t[i] - pull_N[first + i]);
    most = larger(most, t[i] - pull_N[first + i]);
  }
  return most - least;
}

}  // namespace

TensionSolver tension_solver(const RobotParams& table, const CableGeometry& geometry,
                             const TensionRatio& ratio) noexcept {
  TensionSolver solver;
  Index c = 0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    const Index n = static_cast<Index>(table.segment[m].cables);
    for (Index i = 0; i < n; ++i, ++c) {
      for (Index k = 0; k < 2 * (m + 1); ++k) solver.pull_m[c][k] = geometry.jacobian_m_rad[c][k] * ratio[c][k / 2];
      solver.segment[m].p[i] = solver.pull_m[c][2 * m];
      solver.segment[m].q[i] = solver.pull_m[c][2 * m + 1];
    }
    complete(n, solver.segment[m]);
  }
  return solver;
}

CableVector pulls_for(const RobotParams& table, const TensionSolver& solver, const ThetaVector& load_Nm) noexcept {
  CableVector pull_N{};
  Index first = static_cast<Index>(table.cable_count());
  for (Index j = static_cast<Index>(table.segment_count); j-- > 0;) {
    const Index n = static_cast<Index>(table.segment[j].cables);
    const auto beyond = torque_beyond(table, solver, pull_N, first, j);
    first -= n;
    if (!is_solvable(solver.segment[j])) continue;
    const AnchoredVector t = solve(solver.segment[j], n, -load_Nm[2 * j] - beyond[0], -load_Nm[2 * j + 1] - beyond[1]);
    for (Index i = 0; i < n; ++i) pull_N[first + i] = t[i];
  }
  return pull_N;
}

TensionPlan plan_tension(const RobotParams& table, const CableGeometry& geometry, const TensionRatio& ratio,
                         const SegmentVector& lift_N, const PlannedLoad& load) noexcept {
  TensionPlan plan;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
    plan.load_Nm[k] = load.static_Nm[k] + load.inertia_Nm[k];
  const ThetaVector& load_Nm = plan.load_Nm;
  const TensionSolver solver = tension_solver(table, geometry, ratio);
  const CableVector pull_N = pulls_for(table, solver, load.inertia_Nm);
  Index first = static_cast<Index>(table.cable_count());
  const double scale = table.tension.scale(), width_N = kSmoothWidth_N * scale;
  const double margin_N =
      scale *
      (table.friction_mu > kMarginFriction ? kFloorMargin_N * kMarginFriction / table.friction_mu : kFloorMargin_N);
  const Index last = static_cast<Index>(table.first_bending());
  for (Index j = static_cast<Index>(table.segment_count); j-- > last;) {
    const Index n = static_cast<Index>(table.segment[j].cables);
    const auto beyond = torque_beyond(table, solver, plan.motor_N, first, j);
    first -= n;
    const SegmentBalance& balance = solver.segment[j];
    AnchoredVector t{}, null{};
    if (is_solvable(balance)) {
      t = solve(balance, n, -load_Nm[2 * j] - beyond[0], -load_Nm[2 * j + 1] - beyond[1]);
      null = pull_together(balance, n);
      const double level_N = table.tension.plan_N + smaller(0.0, lift_N[j]);
      for (Index i = 0; i < n; ++i) t[i] += level_N * null[i];
    } else {
      plan.balanced = false;
      t.fill(table.tension.plan_N);
    }
    plan.spread_N[j] = spread_of(t, pull_N, first, n);
    // The margin over the floor gives way to the ceiling, the floor itself does not.
    const Shifts s = shifts_for(t, null, &pull_N[first], n, table.tension, margin_N + lift_N[j], width_N);
    const double shift = smooth_maximum(s.least, -smooth_maximum(-s.wanted, -s.most, width_N), width_N);
    for (Index i = 0; i < n; ++i) {
      plan.motor_N[first + i] = t[i] + shift * null[i];
      plan.ceiling_exceeded = plan.ceiling_exceeded || plan.motor_N[first + i] > table.tension.ceiling_free_N;
    }
    plan.floor_acted = plan.floor_acted || s.least > width_N;  // the floor itself, not the margin over it
  }
  return plan;
}

void keep_min_tension(const RobotParams& table, const CableVector& tension_N, SegmentVector& lift_N) noexcept {
  const double scale = table.tension.scale();
  const double limit_N = scale * kLiftLimit_N * larger(0.0, 1.0 - table.friction_mu / kMarginFriction);
  const double enough_N = table.tension.floor_motor_N + scale * kLiftBelow_N;
  Index c = static_cast<Index>(table.feed_count());
  for (Index j = c / 2; j < static_cast<Index>(table.segment_count); ++j) {
    double missing_N = 0.0;
    for (std::int32_t i = 0; i < table.segment[j].cables; ++i, ++c)
      missing_N = larger(missing_N, enough_N - tension_N[c]);
    lift_N[j] = one_tick_tighter(table, lift_N[j], kLiftRate_1_s * missing_N, kLiftLeak_s, limit_N);
  }
}

void wind_in(const RobotParams& table, const CableVector& tension_N, CableVector& taut_N) noexcept {
  const double limit_N = kTautLimit_N * table.tension.scale();
  const double enough_N = table.tension.floor_motor_N + kTautBelow_N * table.tension.scale();
  const Index cables = static_cast<Index>(table.cable_count());
  for (Index c = static_cast<Index>(table.feed_count()); c < cables; ++c) {
    if (taut_N[c] == 0.0 && tension_N[c] >= enough_N) continue;
    const double missing_N = larger(0.0, enough_N - tension_N[c]);
    taut_N[c] = one_tick_tighter(table, taut_N[c], kTautRate_1_s * missing_N, kTautLeak_s, limit_N);
  }
}

CableVector payout_for(const RobotParams& table, const CableLayout& layout, const CableParts& part_m,
                       const TensionRatio& ratio, const CableVector& motor_N) noexcept {
  CableVector payout{};
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    const double strain = motor_N[c] / table.cable_EA_N;
    Pair sum_m{table.lead_m / (1.0 + strain), 0.0};
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]);
         j += 2) {  // two segments at a time; beyond the cable's own there is no part
      sum_m += load_pair(&part_m[c][j]) / (both(1.0) + strain * load_pair(&ratio[c][j]));
    }
    payout[c] = sum(sum_m);
  }
  return payout;
}

}  // namespace liana::cable
