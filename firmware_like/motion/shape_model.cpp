#include "firmware_like/motion/shape_model.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana {
namespace {

using Index = std::size_t;
using Rows = std::array<NullVector, kMaxTheta>;

constexpr double kInside_rad = 1e-12;  // what counts as within bounds

// Cholesky for sizes known at run time only: the leading n x n block, the diagonal then holds 1 / L_jj. False when not positive.
bool factor_in_place(Rows& A, Index n) noexcept {
  for (Index j = 0; j < n; ++j) {
    double diagonal = A[j][j];
    for (Index k = 0; k < j; ++k) diagonal -= A[j][k] * A[j][k];
    if (!(diagonal > 0.0)) return false;
    A[j][j] = 1.0 / std::sqrt(diagonal);
    for (Index i = j + 1; i < n; ++i) {
      double sum = A[i][j];
      for (Index k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
      A[i][j] = sum * A[j][j];
    }
  }
  return true;
}

void solve_in_place(const Rows& L, Index n, NullVector& b) noexcept {
  for (Index i = 0; i < n; ++i) {
    double sum = b[i];
    for (Index k = 0; k < i; ++k) sum -= L[i][k] * b[k];
    b[i] = sum * L[i][i];
  }
  for (Index i = n; i-- > 0;) {
    double sum = b[i];
    for (Index k = i + 1; k < n; ++k) sum -= L[k][i] * b[k];
    b[i] = sum * L[i][i];
  }
}

double product(const NullVector& a, const NullVector& b, Index n) noexcept {
  double sum = 0.0;
  for (Index i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

// A bound on z: normal . z <= bound. `reply` is what a unit force against it changes.
struct Bound {
  NullVector normal;
  NullVector reply;
  double bound;
  double force;
};

// The bounds that hold z back, at most one per dimension.
struct ActiveSet {
  std::array<Bound, kMaxTheta> held;
  Index count = 0;
};

Bound bound_on(const NullSpace& space, const ShapeFactor& factor, Index theta, double side, double value) noexcept {
  Bound out;
  for (Index d = 0; d < static_cast<Index>(space.dimension); ++d)
    out.normal[d] = side * space.component(static_cast<std::int32_t>(d), static_cast<std::int32_t>(theta));
  out.reply = out.normal;
  solve_in_place(factor.row, static_cast<Index>(space.dimension), out.reply);
  out.bound = value;
  out.force = 0.0;
  return out;
}

// How the forces of the active bounds give way to a unit force of `added`, so that they stay met. False when they contradict each other.
bool yielding(const ActiveSet& active, const Bound& added, Index m, NullVector& yield) noexcept {
  Rows S;
  for (Index i = 0; i < active.count; ++i) {
    for (Index j = 0; j <= i; ++j) S[i][j] = product(active.held[i].normal, active.held[j].reply, m);
    yield[i] = product(active.held[i].reply, added.normal, m);
  }
  if (!factor_in_place(S, active.count)) return false;
  solve_in_place(S, active.count, yield);
  return true;
}

// Raises the force of `added` until its bound is met or an active force has fallen to zero; returns the latter's index, else count.
Index press(ActiveSet& active, Bound& added, const NullVector& yield, Index m, NullVector& z) noexcept {
  constexpr double kLeastReply = 1e-12;  // below this the bound depends on the active ones
  NullVector way = added.reply;
  for (Index i = 0; i < active.count; ++i) {
    for (Index d = 0; d < m; ++d) way[d] -= yield[i] * active.held[i].reply[d];
  }
  const double reply = product(added.normal, way, m);
  const bool moves = reply > kLeastReply * product(added.normal, added.reply, m);
  double force = moves ? (product(added.normal, z, m) - added.bound) / reply : 1e300;
  Index released = active.count;
  for (Index i = 0; i < active.count; ++i) {
    if (yield[i] > 0.0 && active.held[i].force < force * yield[i]) force = active.held[i].force / yield[i], released = i;
  }
  if (!moves && released == active.count) return released;
  for (Index i = 0; i < active.count; ++i) active.held[i].force -= force * yield[i];
  added.force += force;
  for (Index d = 0; moves && d < m; ++d) z[d] -= force * way[d];
  return released;
}

// The theta that is farthest outside its bounds; `side` is the bound's, 0 when all are inside.
struct Violation {
  Index theta = 0;
  double side = 0.0;
  double bound = 0.0;
};

Violation worst_violation(const NullSpace& space, const ThetaBounds& bounds, const ThetaVector& v) noexcept {
  Violation worst;
  double most = kInside_rad;
  for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) {
    const double above = v[k] - bounds.high[k], below = bounds.low[k] - v[k];
    if (above > most) most = above, worst = {k, 1.0, bounds.high[k]};
    if (below > most) most = below, worst = {k, -1.0, -bounds.low[k]};
  }
  return worst;
}

void scale_into(const NullSpace& space, const ThetaBounds& bounds, NullPoint& point) noexcept {
  const ThetaVector& v = point.theta_rad;
  double factor = 1.0;
  for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) {
    if (v[k] > bounds.high[k]) factor = smaller(factor, bounds.high[k] / v[k]);
    if (v[k] < bounds.low[k]) factor = smaller(factor, bounds.low[k] / v[k]);
  }
  scale_by(space, factor, point);
}

// Velocity of a pull's point by null-space coordinate, one row per axis.
struct PointMoves {
  std::array<NullVector, 3> axis;
};

PointMoves moves_of(const NullSpace& space, const Pull& pull) noexcept {
  PointMoves move;
  for (Index b = 0; b < static_cast<Index>(space.blocks()); ++b) {
    std::array<Quad, 3> sum{};
    for (Index k = 0; k < static_cast<Index>(pull.columns); ++k) {
      const Quad& share = space.block[b][k];
      for (Index i = 0; i < 3; ++i) {
        const Pair column = both(pull.column[k][i]);
        sum[i].low += column * share.low;
        sum[i].high += column * share.high;
      }
    }
    for (Index i = 0; i < 3; ++i) {
      store_pair(sum[i].low, &move.axis[i][4 * b]);
      store_pair(sum[i].high, &move.axis[i][4 * b + 2]);
    }
  }
  return move;
}

}  // namespace

ShapeModel resting_model(const NullSpace& space, double weight, const ThetaVector& rest_rad) noexcept {
  ShapeModel model;
  model.pull = coordinates(space, rest_rad);
  for (Index i = 0; i < static_cast<Index>(space.dimension); ++i) {
    for (Index j = 0; j < i; ++j) model.curvature[i][j] = 0.0;
    model.curvature[i][i] = weight;
    model.pull[i] *= weight;
  }
  return model;
}

void add_pull(const NullSpace& space, const Pull& pull, ShapeModel& model) noexcept {
  const double across = pull.distance_m > 0.0 ? pull.weight / larger(pull.distance_m, kSharp_m) : 0.0;
  const double along = pull.weight / larger(pull.excess_m, kSharp_m);
  const PointMoves move = moves_of(space, pull);
  NullVector towards;
  for (Index d = 0; d < static_cast<Index>(space.dimension); ++d) {
    const double x = move.axis[0][d], y = move.axis[1][d], z = move.axis[2][d];
    towards[d] = x * pull.towards[0] + y * pull.towards[1] + z * pull.towards[2];
    model.pull[d] += along * pull.excess_m * towards[d];
    const double more = (along - across) * towards[d], ax = across * x, ay = across * y, az = across * z;
    for (Index i = 0; i <= d; ++i)
      model.curvature[d][i] += ax * move.axis[0][i] + ay * move.axis[1][i] + az * move.axis[2][i] + more * towards[i];
  }
}

ThetaBounds room_to_limits(const RobotTable& table, const ThetaVector& theta_rad, double share) noexcept {
  ThetaBounds bounds;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = table.segment[k / 2].theta_limit_rad;
    bounds.high[k] = larger(0.0, limit - theta_rad[k]) * share;
    bounds.low[k] = smaller(0.0, -limit - theta_rad[k]) * share;
  }
  return bounds;
}

ShapeFactor factor(const NullSpace& space, const ShapeModel& model) noexcept {
  ShapeFactor out;
  for (Index i = 0; i < static_cast<Index>(space.dimension); ++i) {
    for (Index j = 0; j <= i; ++j) out.row[i][j] = model.curvature[i][j];
  }
  factor_in_place(out.row, static_cast<Index>(space.dimension));
  return out;
}

ShapeFactor unit_factor(const NullSpace& space) noexcept {
  ShapeFactor out;
  for (Index i = 0; i < static_cast<Index>(space.dimension); ++i) {
    for (Index j = 0; j < i; ++j) out.row[i][j] = 0.0;
    out.row[i][i] = 1.0;
  }
  return out;
}

NullVector minimum(const NullSpace& space, const ShapeFactor& factor, const NullVector& pull) noexcept {
  NullVector z = pull;
  solve_in_place(factor.row, static_cast<Index>(space.dimension), z);
  return z;
}

void scale_by(const NullSpace& space, double factor, NullPoint& point) noexcept {
  for (Index d = 0; d < static_cast<Index>(space.dimension); ++d) point.z[d] *= factor;
  for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) point.theta_rad[k] *= factor;
}

void restrict_to(const NullSpace& space, const ShapeFactor& factor, const ThetaBounds& bounds, NullPoint& point) noexcept {
  const Index m = static_cast<Index>(space.dimension);
  ActiveSet active;
  Violation worst = worst_violation(space, bounds, point.theta_rad);
  if (worst.side == 0.0) return;
  Bound added = bound_on(space, factor, worst.theta, worst.side, worst.bound);
  for (Index pass = 0; pass < 4 * m && active.count <= m; ++pass) {
    NullVector yield;
    if (!yielding(active, added, m, yield)) break;
    const Index released = press(active, added, yield, m, point.z);
    if (released < active.count) {
      active.held[released] = active.held[--active.count];
      continue;
    }
    point.theta_rad = combine(space, point.z);
    worst = worst_violation(space, bounds, point.theta_rad);
    if (worst.side == 0.0) return;
    if (active.count == m) break;
    active.held[active.count++] = added;
    added = bound_on(space, factor, worst.theta, worst.side, worst.bound);
  }
  point.theta_rad = combine(space, point.z);
  scale_into(space, bounds, point);
}

}  // namespace liana
