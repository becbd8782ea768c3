#include "firmware_like/cable/shape/null_space.hpp"

#include <cmath>

namespace liana::cable {
namespace {

using Index = std::size_t;

constexpr Index kRows = 6;
constexpr double kDependent_m_rad = 1e-10;  // below this a row adds nothing that the tip could feel

// I - scale v v^T; v is zero before `from`, which is even.
struct Reflection {
  const double* v;
  double scale;
  Index from;
};

inline void reflect(const Reflection& r, Index to, double* x) noexcept {
  const Index pairs = (to - r.from) / 2;
  const double* const v = r.v + r.from;
  add_scaled_pairs(-r.scale * dot_pairs(v, x + r.from, pairs), v, x + r.from, pairs);
}

// The rows of J over free thetas, one after the other, and which thetas these are.
struct FreeRows {
  std::array<std::array<double, kMaxTheta>, kRows> row;
  std::array<Index, kMaxTheta> theta;
  Index count = 0;
};

void gather(const Jacobian& J, Index n, std::uint32_t fixed, FreeRows& out) noexcept {
  for (Index k = 0; k < n; ++k) {
    if (((fixed >> k) & 1u) != 0) continue;
    for (Index r = 0; r < 3; ++r) {
      out.row[r][out.count] = J.linear[k][r];
      out.row[r + 3][out.count] = J.angular[k][r];
    }
    out.theta[out.count++] = k;
  }
  if (out.count % 2 == 1) {
    for (auto& row : out.row) row[out.count] = 0.0;  // the last pair's second lane
  }
}

// Turns the rows into the reflections that carry their span onto the first `rank` axes; returns the rank.
Index reflections_of(FreeRows& free, Index to, std::array<Reflection, kRows>& reflection) noexcept {
  Index rank = 0;
  for (Index r = 0; r < kRows; ++r) {
    double* const v = free.row[r].data();
    const Index from = rank & ~Index{1};
    if (rank > from) v[from] = 0.0;
    const double length = std::sqrt(dot_pairs(v + from, v + from, (to - from) / 2));
    if (!(length > kDependent_m_rad)) continue;
    const double pivot = v[rank];
    v[rank] = pivot < 0.0 ? pivot - length : pivot + length;
    reflection[rank] = {v, 1.0 / (length * (length + std::fabs(pivot))), from};
    for (Index s = r + 1; s < kRows; ++s) reflect(reflection[rank], to, free.row[s].data());
    ++rank;
  }
  return rank;
}

// Four columns of the reflections' product, from `axis` on: basis vectors over the free thetas.
void basis_block(const std::array<Reflection, kRows>& reflection, Index rank, Index axis, Index count,
                 std::array<Quad, kMaxTheta>& c) noexcept {
  for (Index k = 0; k < count; ++k) c[k] = Quad{};
  for (Index i = 0; i < 4 && axis + i < count; ++i) {
    Pair& half = i < 2 ? c[axis + i].low : c[axis + i].high;
    half[i % 2] = 1.0;
  }
  for (Index q = rank; q-- > 0;) {
    const double* const v = reflection[q].v;
    Quad sum{};
    for (Index k = q; k < count; ++k) {
      const Pair weight = both(v[k]);
      sum.low += weight * c[k].low;
      sum.high += weight * c[k].high;
    }
    const Pair scale = both(reflection[q].scale);
    sum.low *= scale;
    sum.high *= scale;
    for (Index k = q; k < count; ++k) {
      const Pair weight = both(v[k]);
      c[k].low -= weight * sum.low;
      c[k].high -= weight * sum.high;
    }
  }
}

// From the free thetas, which are the first ones, to their own places; zero in between.
void spread(const FreeRows& free, Index n, std::array<Quad, kMaxTheta>& c) noexcept {
  Index from = free.count;
  for (Index k = n; k-- > 0;) c[k] = from > 0 && free.theta[from - 1] == k ? c[--from] : Quad{};
}

}  // namespace

double NullSpace::component(std::int32_t index, std::int32_t theta) const noexcept {
  const Quad& four = block[static_cast<Index>(index / 4)][static_cast<Index>(theta)];
  const Pair& half = index % 4 < 2 ? four.low : four.high;
  return half[index % 2];
}

NullSpace null_space(const Jacobian& J, std::int32_t theta_count, std::uint32_t fixed) noexcept {
  const Index n = static_cast<Index>(theta_count);
  NullSpace space;
  space.theta_count = theta_count;
  FreeRows free;
  gather(J, n, fixed, free);
  std::array<Reflection, kRows> reflection;
  const Index rank = reflections_of(free, free.count + free.count % 2, reflection);
  space.dimension = static_cast<std::int32_t>(free.count - rank);
  for (Index b = 0; b < static_cast<Index>(space.blocks()); ++b) {
    basis_block(reflection, rank, rank + 4 * b, free.count, space.block[b]);
    if (free.count < n) spread(free, n, space.block[b]);
  }
  return space;
}

NullVector coordinates(const NullSpace& space, const ThetaVector& v) noexcept {
  NullVector z;
  for (Index b = 0; b < static_cast<Index>(space.blocks()); ++b) {
    Quad sum{};
    for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) {
      const Pair weight = both(v[k]);
      sum.low += weight * space.block[b][k].low;
      sum.high += weight * space.block[b][k].high;
    }
    store_pair(sum.low, &z[4 * b]);
    store_pair(sum.high, &z[4 * b + 2]);
  }
  return z;
}

ThetaVector combine(const NullSpace& space, const NullVector& z) noexcept {
  ThetaVector v{};
  for (Index b = 0; b < static_cast<Index>(space.blocks()); ++b) {
    const Pair low = load_pair(&z[4 * b]), high = load_pair(&z[4 * b + 2]);
    for (Index k = 0; k < static_cast<Index>(space.theta_count); ++k) {
      const Pair share = low * space.block[b][k].low + high * space.block[b][k].high;
      v[k] += sum(share);
    }
  }
  return v;
}

ThetaVector project(const NullSpace& space, const ThetaVector& v) noexcept {
  return combine(space, coordinates(space, v));
}

}  // namespace liana::cable
