// Quadratic model of what the shape wants, in null-space coordinates z, and its minimum; bounds.hpp brings that within
// joint limits.
//
//   minimise  z^T curvature z / 2 - pull^T z     subject to  low <= Z z <= high      (Z: basis of the null space)
//
// An excess x >= 0 (a distance beyond what is allowed) with weight w and direction u is a pull of constant strength w
// along u that fades out within kSharp_m of zero; its curvature is that of weighted least squares, w / x along u. The
// minimum of the model is then the step that brings the excess to zero where it can, and a fixed point of stepping
// minimises the sum of w x (iteratively reweighted least squares: E. Weiszfeld, 1937).
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/shape/null_space.hpp"

namespace liana::cable {

constexpr double kSharp_m = 0.001;  // excesses are rounded off within this

struct ShapeModel {
  std::array<NullVector, kMaxTheta> curvature;  // lower triangle of the leading dimension x dimension block
  NullVector pull;
};

// Everything pulls to `rest_rad` (a change of theta) with curvature `weight` (> 0) in every direction.
ShapeModel resting_model(const NullSpace& space, double weight, const ThetaVector& rest_rad) noexcept;

// A point of the arm that should move by `excess_m` (> 0) along the unit vector `towards`.
struct Pull {
  double weight;
  double excess_m;
  double distance_m;  // from what pulls or pushes: curvature across `towards`; 0 = none
  Vec3 towards;
  std::array<Vec3, kMaxTheta>
      column;  // of the point's Jacobian; the first `columns` (an even number) are set, the others zero
  std::int32_t columns;
};

// What pulls want together, by theta: it goes on to hold for a while when the arm moves on, and its null space turns.
struct PullSum {
  std::array<ThetaVector, kMaxTheta> curvature{};  // lower triangle
  ThetaVector pull{};
};

// Nothing wanted yet of the first `theta_count` thetas; one more pull; and the whole sum as part of a model, in
// null-space coordinates.
void reset_pulls(std::int32_t theta_count, PullSum& sum) noexcept;
void add_pull(const Pull& pull, PullSum& sum) noexcept;
void add_pulls(const NullSpace& space, const PullSum& sum, ShapeModel& model) noexcept;

// Cholesky factor of a model's curvature; fails never, as a resting model is positive.
struct ShapeFactor {
  std::array<NullVector, kMaxTheta> row;
};
ShapeFactor factor(const NullSpace& space, const ShapeModel& model) noexcept;

// The model's minimum without bounds.
NullVector minimum(const NullSpace& space, const ShapeFactor& factor, const NullVector& pull) noexcept;

// L^T x = b in place, L the factor.
void solve_upper(const NullSpace& space, const ShapeFactor& factor, NullVector& b) noexcept;

}  // namespace liana::cable
