// What the arm can do while its tip stands still: the null space of the tip Jacobian as an orthonormal basis.
//
// A true projector, not a damped inverse: |J dtheta| <= 1e-9 |dtheta| for every vector of the basis, at singular poses,
// too. Householder reflections of the rows of J (G. H. Golub, Numer. Math. 7, 1965): orthogonal to rounding whatever J
// is.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/math/pair.hpp"

namespace liana::cable {

// Coordinates in the basis of a null space: `dimension` numbers, then zeros up to a multiple of four.
using NullVector = std::array<double, kMaxTheta>;

// Components of one theta in four vectors of the basis, computed together.
struct Quad {
  Pair low, high;
};

// Basis vector 4 b + i has the component block[b][k] (lane i) in theta k. Vectors beyond `dimension` are zero, blocks
// without any are not set, nor are thetas beyond theta_count.
struct NullSpace {
  std::array<std::array<Quad, kMaxTheta>, kMaxTheta / 4> block;
  std::int32_t dimension = 0;
  std::int32_t theta_count = 0;

  std::int32_t blocks() const noexcept { return (dimension + 3) / 4; }
  // Component of basis vector `index` in `theta`.
  double component(std::int32_t index, std::int32_t theta) const noexcept;
};

// Null space over the thetas that `fixed` (bit i: theta i stands still) leaves free. Dimension: free thetas less the
// rank of their columns, where what a row adds to the others counts from 1e-10 m/rad on. Cost: six reflections applied
// to six rows and to the basis.
NullSpace null_space(const Jacobian& J, std::int32_t theta_count, std::uint32_t fixed) noexcept;

// Coordinates of the projection of v, and the vector of coordinates z (zero beyond theta_count).
NullVector coordinates(const NullSpace& space, const ThetaVector& v) noexcept;
ThetaVector combine(const NullSpace& space, const NullVector& z) noexcept;
ThetaVector project(const NullSpace& space, const ThetaVector& v) noexcept;

}  // namespace liana::cable
