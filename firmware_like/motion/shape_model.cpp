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

// L^T x = b.
void solve_upper(const Rows& L, Index n, NullVector& b) noexcept {
  for (Index i = n; i-- > 0;) {
    double sum = b[i];
    for (Index k = i + 1; k < n; ++k) sum -= L[k][i] * b[k];
    b[i] = sum * L[i][i];
  }
}

// L L^T x = b.
void solve_in_place(const Rows& L, Index n, NullVector& b) noexcept {
  for (Index i = 0; i < n; ++i) {
    double sum = b[i];
    for (Index k = 0; k < i; ++k) sum -= L[i][k] * b[k];
    b[i] = sum * L[i][i];
  }
  solve_upper(L, n, b);
}

// The theta that is farthest outside its bounds; `side` is the bound's, 0 when all are inside.
struct Violation {
  Index theta = 0;
  double side = 0.0;
};

Violation worst_violation(const NullSpace& space, const ThetaBounds& bounds, const ThetaVector& v) noexcept {
  Violation worst;
  double most = kInside_rad;
  for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) {
    const double above = v[k] - bounds.high[k], below = bounds.low[k] - v[k];
    if (above > most) most = above, worst = {k, 1.0};
    if (below > most) most = below, worst = {k, -1.0};
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

// Null-space coordinates, B lanes of four; those beyond the dimension are zero.
template <Index B>
using Lanes = std::array<Quad, B>;

template <Index B>
inline double product(const Lanes<B>& a, const Lanes<B>& b) noexcept {
  Pair products = a[0].low * b[0].low + a[0].high * b[0].high;
  for (Index i = 1; i < B; ++i) products += a[i].low * b[i].low + a[i].high * b[i].high;
  return sum(products);
}

template <Index B>
inline void add_scaled(double s, const Lanes<B>& x, Lanes<B>& y) noexcept {
  const Pair twice = both(s);
  for (Index i = 0; i < B; ++i) {
    y[i].low += twice * x[i].low;
    y[i].high += twice * x[i].high;
  }
}

template <Index B>
inline Lanes<B> scaled(double s, const Lanes<B>& x) noexcept {
  const Pair twice = both(s);
  Lanes<B> y;
  for (Index i = 0; i < B; ++i) y[i] = {twice * x[i].low, twice * x[i].high};
  return y;
}

template <Index B>
inline Lanes<B> lanes_of(const NullVector& z) noexcept {
  Lanes<B> lanes;
  for (Index b = 0; b < B; ++b) lanes[b] = {load_pair(&z[4 * b]), load_pair(&z[4 * b + 2])};
  return lanes;
}

template <Index B>
inline NullVector numbers_of(const Lanes<B>& lanes) noexcept {
  NullVector z;
  for (Index b = 0; b < B; ++b) {
    store_pair(lanes[b].low, &z[4 * b]);
    store_pair(lanes[b].high, &z[4 * b + 2]);
  }
  return z;
}

// Coordinates in which the metric of a problem is the distance: theta k is axis[k] . y, within bounds.
template <Index B>
struct Frame {
  std::array<Lanes<B>, kMaxTheta> axis;
  Index thetas;
  const ThetaBounds* bounds;

  double bound(Index theta, double side) const noexcept { return side > 0.0 ? bounds->high[theta] : -bounds->low[theta]; }
};

// Without a metric: the basis of the null space as it is. With one: L^-1 times it.
template <Index B>
void take_axes(const NullSpace& space, const ShapeFactor* factor, Frame<B>& frame) noexcept {
  const Index m = static_cast<Index>(space.dimension), used = static_cast<Index>(space.blocks());
  std::array<Lanes<B>, 4 * B> column;  // of L^-1
  for (Index e = 0; factor != nullptr && e < 4 * used; ++e) {
    NullVector x{};
    if (e < m) x[e] = factor->row[e][e];
    for (Index i = e + 1; i < m; ++i) {
      double rest = 0.0;
      for (Index d = e; d < i; ++d) rest -= factor->row[i][d] * x[d];
      x[i] = rest * factor->row[i][i];
    }
    column[e] = lanes_of<B>(x);
  }
  for (Index k = 0; k < frame.thetas; ++k) {
    Lanes<B>& axis = frame.axis[k];
    axis = Lanes<B>{};
    for (Index b = 0; b < used; ++b) {
      const Quad& four = space.block[b][k];
      if (factor == nullptr) {
        axis[b] = four;
        continue;
      }
      add_scaled(four.low[0], column[4 * b], axis);
      add_scaled(four.low[1], column[4 * b + 1], axis);
      add_scaled(four.high[0], column[4 * b + 2], axis);
      add_scaled(four.high[1], column[4 * b + 3], axis);
    }
  }
}

// One bound that holds y back, and its force.
struct Active {
  Index theta;
  double side, force;
};

// All of them in the order in which they came, at most one per dimension: normals q r with orthonormal q and triangular r.
template <Index B>
struct ActiveSet {
  std::array<Active, 4 * B> bound;
  std::array<Lanes<B>, 4 * B> q;
  std::array<std::array<double, 4 * B>, 4 * B + 1> r;  // r[i]: column of bound i; the last one is of a bound that is yet to come
  Index count = 0;
};

constexpr double kLeastReply = 1e-12;  // below this a bound depends on those before it

// The normal of one more bound: its parts along those before it are put into their column, `rest` is what remains.
template <Index B>
struct Normal {
  Lanes<B> rest;
  double length2, rest2;
  bool is_new() const noexcept { return rest2 > kLeastReply * length2; }
};

template <Index B>
inline Normal<B> normal_of(const Frame<B>& frame, const Active& bound, Index i, ActiveSet<B>& active) noexcept {
  Normal<B> out;
  out.rest = scaled(bound.side, frame.axis[bound.theta]);
  out.length2 = product(out.rest, out.rest);
  for (Index j = 0; j < i; ++j) {
    const double part = product(active.q[j], out.rest);
    active.r[i][j] = part;
    add_scaled(-part, active.q[j], out.rest);
  }
  out.rest2 = product(out.rest, out.rest);
  return out;
}

template <Index B>
inline void append(const Active& bound, const Normal<B>& normal, ActiveSet<B>& active) noexcept {
  const Index i = active.count++;
  const double length = std::sqrt(normal.rest2);
  active.bound[i] = bound;
  active.r[i][i] = length;
  active.q[i] = scaled(1.0 / length, normal.rest);
}

// Leaves out one bound; those after it are taken up again.
template <Index B>
void release(const Frame<B>& frame, Index released, ActiveSet<B>& active) noexcept {
  const Index count = active.count;
  active.count = released;
  for (Index i = released + 1; i < count; ++i) {
    const Active bound = active.bound[i];
    append(bound, normal_of(frame, bound, active.count, active), active);
  }
}

enum class Pressed { kMet, kReleased, kContradicted };

// Raises the force of one more bound until it is met, and then active, or until an active force has fallen to zero.
template <Index B>
Pressed press(const Frame<B>& frame, Active& added, ActiveSet<B>& active, Lanes<B>& y) noexcept {
  const Index count = active.count;
  const Normal<B> normal = normal_of(frame, added, count, active);
  const bool moves = count < 4 * B && normal.is_new();
  const double beyond = added.side * product(frame.axis[added.theta], y) - frame.bound(added.theta, added.side);
  double more = moves ? beyond / normal.rest2 : 1e300;
  std::array<double, 4 * B> yield;  // how active forces give way, so that their bounds stay met
  Index released = count;
  for (Index i = count; i-- > 0;) {
    double left = active.r[count][i];
    for (Index j = i + 1; j < count; ++j) left -= active.r[j][i] * yield[j];
    yield[i] = left / active.r[i][i];
    if (yield[i] > 0.0 && active.bound[i].force < more * yield[i]) more = active.bound[i].force / yield[i], released = i;
  }
  if (!moves && released == count) return Pressed::kContradicted;
  for (Index i = 0; i < count; ++i) active.bound[i].force -= more * yield[i];
  added.force += more;
  if (moves) add_scaled(-more, normal.rest, y);
  if (released < count) {
    release(frame, released, active);
    return Pressed::kReleased;
  }
  append(added, normal, active);
  return Pressed::kMet;
}

// Takes up bounds as equalities, those that depend on others left out.
template <Index B>
void recall(const Frame<B>& frame, const HeldBounds& held, ActiveSet<B>& active) noexcept {
  active.count = 0;
  const std::uint32_t any = held.low | held.high;
  for (Index k = 0; k < frame.thetas && active.count < 4 * B; ++k) {
    if (((any >> k) & 1u) == 0) continue;
    const Active bound{k, ((held.high >> k) & 1u) != 0 ? 1.0 : -1.0, 0.0};
    const Normal<B> normal = normal_of(frame, bound, active.count, active);
    if (normal.is_new()) append(bound, normal, active);
  }
}

// Moves y to where all active bounds are met as equalities; returns the least of the forces that this takes, or 0.
template <Index B>
double press_all(const Frame<B>& frame, ActiveSet<B>& active, Lanes<B>& y) noexcept {
  std::array<double, 4 * B> along;
  const Lanes<B> free = y;
  for (Index i = 0; i < active.count; ++i) {
    const Active& bound = active.bound[i];
    double left = bound.side * product(frame.axis[bound.theta], free) - frame.bound(bound.theta, bound.side);
    for (Index j = 0; j < i; ++j) left -= active.r[i][j] * along[j];
    along[i] = left / active.r[i][i];
    add_scaled(-along[i], active.q[i], y);
  }
  double least = 0.0;
  for (Index i = active.count; i-- > 0;) {
    double left = along[i];
    for (Index j = i + 1; j < active.count; ++j) left -= active.r[j][i] * active.bound[j].force;
    active.bound[i].force = left / active.r[i][i];
    least = smaller(least, active.bound[i].force);
  }
  return least;
}

// Bounds that push, or all.
template <Index B>
HeldBounds held_by(const ActiveSet<B>& active, bool only_pushing) noexcept {
  HeldBounds held;
  for (Index i = 0; i < active.count; ++i) {
    if (only_pushing && active.bound[i].force < 0.0) continue;
    (active.bound[i].side > 0.0 ? held.high : held.low) |= 1u << active.bound[i].theta;
  }
  return held;
}

// Begins with the bounds that were held last, but for those that would have to pull.
template <Index B>
void begin_with(const Frame<B>& frame, const HeldBounds& held, ActiveSet<B>& active, Lanes<B>& y) noexcept {
  const Lanes<B> free = y;
  recall(frame, held, active);
  if (press_all(frame, active, y) >= 0.0) return;
  y = free;
  recall(frame, held_by(active, true), active);
  if (press_all(frame, active, y) >= 0.0) return;
  y = free;
  active.count = 0;
}

// Moves y to the nearest point within bounds; false when that takes more passes.
template <Index B>
bool restrict_in(const NullSpace& space, const Frame<B>& frame, std::int32_t passes, HeldBounds& held, Lanes<B>& y) noexcept {
  ActiveSet<B> active;
  if ((held.low | held.high) != 0) begin_with(frame, held, active, y);
  Active added{};
  Pressed pressed = Pressed::kMet;
  for (std::int32_t pass = 0;; ++pass) {
    if (pressed == Pressed::kMet) {
      ThetaVector theta;
      for (Index k = 0; k < frame.thetas; ++k) theta[k] = product(frame.axis[k], y);
      const Violation worst = worst_violation(space, *frame.bounds, theta);
      added = {worst.theta, worst.side, 0.0};
    }
    const bool inside = added.side == 0.0;
    if (inside || pass == passes || pressed == Pressed::kContradicted) {
      held = held_by(active, false);
      return inside;
    }
    pressed = press(frame, added, active, y);
  }
}

// The same from z to z, in a metric or (nullptr) without.
template <Index B>
bool restrict_coordinates(const NullSpace& space, const ShapeFactor* factor, const ThetaBounds& bounds, std::int32_t passes,
                          HeldBounds& held, NullVector& z) noexcept {
  Frame<B> frame;
  frame.thetas = static_cast<Index>(space.theta_count);
  frame.bounds = &bounds;
  take_axes(space, factor, frame);
  const Index m = static_cast<Index>(space.dimension);
  NullVector in_frame{};
  for (Index d = 0; d < m; ++d) {
    in_frame[d] = z[d];
    if (factor == nullptr) continue;
    in_frame[d] /= factor->row[d][d];  // y = L^T z
    for (Index e = d + 1; e < m; ++e) in_frame[d] += factor->row[e][d] * z[e];
  }
  Lanes<B> y = lanes_of<B>(in_frame);
  const bool inside = restrict_in(space, frame, passes, held, y);
  const NullVector found = numbers_of(y);
  for (Index d = 0; d < m; ++d) z[d] = found[d];
  if (factor != nullptr) solve_upper(factor->row, m, z);
  return inside;
}

void restrict_point(const NullSpace& space, const ShapeFactor* factor, const ThetaBounds& bounds, std::int32_t passes, HeldBounds& held,
                    NullPoint& point) noexcept {
  if (worst_violation(space, bounds, point.theta_rad).side == 0.0) {
    held = HeldBounds{};
    return;
  }
  const auto restricted = space.blocks() == 1   ? restrict_coordinates<1>
                          : space.blocks() == 2 ? restrict_coordinates<2>
                                                : restrict_coordinates<kMaxTheta / 4>;
  const bool inside = restricted(space, factor, bounds, passes, held, point.z);
  point.theta_rad = combine(space, point.z);
  if (!inside) scale_into(space, bounds, point);
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

void reset_pulls(std::int32_t theta_count, PullSum& sum) noexcept {
  for (Index k = 0; k < static_cast<Index>(theta_count); ++k) sum.curvature[k] = ThetaVector{};
  sum.pull = ThetaVector{};
}

void add_pull(const Pull& pull, PullSum& sum) noexcept {
  const double across = pull.distance_m > 0.0 ? pull.weight / larger(pull.distance_m, kSharp_m) : 0.0;
  const double along = pull.weight / larger(pull.excess_m, kSharp_m);
  const Vec3& u = pull.towards;
  std::array<ThetaVector, 4> move;  // of the point by theta: x, y, z, and towards
  for (Index k = 0; k < static_cast<Index>(pull.columns); ++k) {
    const Vec3& column = pull.column[k];
    for (Index i = 0; i < 3; ++i) move[i][k] = column[i];
    move[3][k] = column[0] * u[0] + column[1] * u[1] + column[2] * u[2];
  }
  for (Index k = 0; k < static_cast<Index>(pull.columns); ++k) {
    sum.pull[k] += along * pull.excess_m * move[3][k];
    const Pair more = both((along - across) * move[3][k]), x = both(across * move[0][k]), y = both(across * move[1][k]),
               z = both(across * move[2][k]);
    for (Index j = 0; j <= k; j += 2) {
      double* const entry = &sum.curvature[k][j];
      store_pair(load_pair(entry) + x * load_pair(&move[0][j]) + y * load_pair(&move[1][j]) + z * load_pair(&move[2][j]) +
                     more * load_pair(&move[3][j]),
                 entry);
    }
  }
}

void add_pulls(const NullSpace& space, const PullSum& sum, ShapeModel& model) noexcept {
  const Index m = static_cast<Index>(space.dimension), n = static_cast<Index>(space.theta_count);
  std::array<NullVector, kMaxTheta> half;  // lower triangle times the basis, the diagonal halved: the product is symmetric
  for (Index b = 0; b < static_cast<Index>(space.blocks()); ++b) {
    for (Index k = 0; k < n; ++k) {
      Quad row{};
      for (Index j = 0; j <= k; ++j) {
        const Pair entry = both(j == k ? 0.5 * sum.curvature[k][j] : sum.curvature[k][j]);
        row.low += entry * space.block[b][j].low;
        row.high += entry * space.block[b][j].high;
      }
      store_pair(row.low, &half[k][4 * b]);
      store_pair(row.high, &half[k][4 * b + 2]);
    }
  }
  const NullVector pull = coordinates(space, sum.pull);
  std::array<NullVector, kMaxTheta> product;
  for (Index e = 0; e < m; ++e) {
    ThetaVector column;
    for (Index k = 0; k < n; ++k) column[k] = half[k][e];
    product[e] = coordinates(space, column);
  }
  for (Index d = 0; d < m; ++d) {
    model.pull[d] += pull[d];
    for (Index e = 0; e <= d; ++e) model.curvature[d][e] += product[e][d] + product[d][e];
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

NullVector minimum(const NullSpace& space, const ShapeFactor& factor, const NullVector& pull) noexcept {
  NullVector z = pull;
  solve_in_place(factor.row, static_cast<Index>(space.dimension), z);
  return z;
}

void scale_by(const NullSpace& space, double factor, NullPoint& point) noexcept {
  for (Index d = 0; d < static_cast<Index>(space.dimension); ++d) point.z[d] *= factor;
  for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) point.theta_rad[k] *= factor;
}

void restrict_to(const NullSpace& space, const ShapeFactor& factor, const ThetaBounds& bounds, std::int32_t passes, HeldBounds& held,
                 NullPoint& point) noexcept {
  restrict_point(space, &factor, bounds, passes, held, point);
}

void restrict_to(const NullSpace& space, const ThetaBounds& bounds, std::int32_t passes, HeldBounds& held, NullPoint& point) noexcept {
  restrict_point(space, nullptr, bounds, passes, held, point);
}

}  // namespace liana
