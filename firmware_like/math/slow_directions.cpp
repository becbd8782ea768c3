#include "firmware_like/math/slow_directions.hpp"

#include <cmath>
#include <cstdint>

namespace liana {
namespace {

using Index = std::size_t;

constexpr std::int32_t kSweeps = 5;  // the error of a sweep is squared by the next

Index place(Index row, Index column) noexcept {
  return row >= column ? row * (row + 1) / 2 + column : column * (column + 1) / 2 + row;
}

// Turns coordinates p and q so that their element is zero, r being the third.
void rotate_out(Index p, Index q, Index r, Symmetric3& A, std::array<Vec3, 3>& vectors) noexcept {
  const double off = A[place(p, q)];
  if (off == 0.0) return;
  const double half = 0.5 * (A[place(q, q)] - A[place(p, p)]) / off;
  const double t = (half < 0.0 ? -1.0 : 1.0) / (std::fabs(half) + std::sqrt(half * half + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  A[place(p, p)] -= t * off;
  A[place(q, q)] += t * off;
  A[place(p, q)] = 0.0;
  const double rp = A[place(r, p)], rq = A[place(r, q)];
  A[place(r, p)] = c * rp - s * rq;
  A[place(r, q)] = s * rp + c * rq;
  const Vec3 u = vectors[p], v = vectors[q];
  vectors[p] = subtract(scale(u, c), scale(v, s));
  vectors[q] = add(scale(u, s), scale(v, c));
}

}  // namespace

Vec3 slowed(const SlowDirections& slow, const Vec3& motion) noexcept {
  Vec3 out{};
  for (Index i = 0; i < 3; ++i) out = add(out, scale(slow.axis[i], slow.share[i] * dot(slow.axis[i], motion)));
  return out;
}

std::array<Vec3, 3> eigenvectors(Symmetric3 matrix) noexcept {
  std::array<Vec3, 3> vectors = SlowDirections{}.axis;
  for (std::int32_t sweep = 0; sweep < kSweeps; ++sweep) {
    rotate_out(0, 1, 2, matrix, vectors);
    rotate_out(0, 2, 1, matrix, vectors);
    rotate_out(1, 2, 0, matrix, vectors);
  }
  return vectors;
}

}  // namespace liana
