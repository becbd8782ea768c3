#include "firmware_like/cable/shape/bounds.hpp"

#include "firmware_like/cable/shape/active_set.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

constexpr double kInside_rad = 1e-12;  // what counts as within bounds

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

// Moves y to the nearest point within bounds; false when that takes more passes.
template <Index B>
bool restrict_in(const NullSpace& space, const Frame<B>& frame, std::int32_t passes, HeldBounds& held,
                 Lanes<B>& y) noexcept {
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
bool restrict_coordinates(const NullSpace& space, const ShapeFactor* factor, const ThetaBounds& bounds,
                          std::int32_t passes, HeldBounds& held, NullVector& z) noexcept {
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
  if (factor != nullptr) solve_upper(space, *factor, z);
  return inside;
}

void restrict_point(const NullSpace& space, const ShapeFactor* factor, const ThetaBounds& bounds, std::int32_t passes,
                    HeldBounds& held, NullPoint& point) noexcept {
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

ThetaBounds room_to_limits(const RobotParams& table, const ThetaVector& theta_rad, double share) noexcept {
  ThetaBounds bounds;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = table.segment[k / 2].theta_limit_rad;
    bounds.high[k] = larger(0.0, limit - theta_rad[k]) * share;
    bounds.low[k] = smaller(0.0, -limit - theta_rad[k]) * share;
  }
  return bounds;
}

void scale_by(const NullSpace& space, double factor, NullPoint& point) noexcept {
  for (Index d = 0; d < static_cast<Index>(space.dimension); ++d) point.z[d] *= factor;
  for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) point.theta_rad[k] *= factor;
}

void restrict_to(const NullSpace& space, const ShapeFactor& factor, const ThetaBounds& bounds, std::int32_t passes,
                 HeldBounds& held, NullPoint& point) noexcept {
  restrict_point(space, &factor, bounds, passes, held, point);
}

void restrict_to(const NullSpace& space, const ThetaBounds& bounds, std::int32_t passes, HeldBounds& held,
                 NullPoint& point) noexcept {
  restrict_point(space, nullptr, bounds, passes, held, point);
}

}  // namespace liana::cable
