// Three directions at right angles to each other, along each of which only a share of a motion is allowed.
#pragma once

#include <array>

#include "firmware_like/math/pose.hpp"

namespace liana {

// A symmetric matrix of 3 x 3 by its lower triangle: xx, yx, yy, zx, zy, zz.
using Symmetric3 = std::array<double, 6>;

struct SlowDirections {
  std::array<Vec3, 3> axis{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};  // unit vectors
  Vec3 share{1.0, 1.0, 1.0};                                                      // > 0, 1 at most
};

// True when every direction may be used in full.
inline bool is_even(const SlowDirections& slow) noexcept {
  return slow.share[0] == 1.0 && slow.share[1] == 1.0 && slow.share[2] == 1.0;
}

// What is left of a motion when each direction has its share.
Vec3 slowed(const SlowDirections& slow, const Vec3& motion) noexcept;

// Unit eigenvectors of a symmetric matrix: Jacobi's rotations, five sweeps of three (Golub and Van Loan, Matrix
// Computations, 8.5). Cost: 1,200 instructions.
std::array<Vec3, 3> eigenvectors(Symmetric3 matrix) noexcept;

}  // namespace liana
