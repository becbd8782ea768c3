// Quadratic model of what the shape wants, in null-space coordinates z, and its minimum within bounds on the thetas.
//
//   minimise  z^T curvature z / 2 - pull^T z     subject to  low <= Z z <= high      (Z: basis of the null space)
//
// An excess x >= 0 (a distance beyond what is allowed) with weight w and direction u is a pull of constant strength w along u that fades
// out within kSharp_m of zero; its curvature is that of weighted least squares, w / x along u. The minimum of the model is then the step
// that brings the excess to zero where it can, and a fixed point of stepping minimises the sum of w x (iteratively reweighted least
// squares: E. Weiszfeld, 1937).
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/motion/null_space.hpp"

namespace liana {

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
  std::array<Vec3, kMaxTheta> column;  // of the point's Jacobian; the first `columns` (an even number) are set, the others zero
  std::int32_t columns;
};

// What pulls want together, by theta: it goes on to hold for a while when the arm moves on, and its null space turns.
struct PullSum {
  std::array<ThetaVector, kMaxTheta> curvature{};  // lower triangle
  ThetaVector pull{};
};
void reset_pulls(std::int32_t theta_count, PullSum& sum) noexcept;
void add_pull(const Pull& pull, PullSum& sum) noexcept;
void add_pulls(const NullSpace& space, const PullSum& sum, ShapeModel& model) noexcept;

struct ThetaBounds {
  ThetaVector low;   // <= 0
  ThetaVector high;  // >= 0
};

// Room to the joint limits divided by `share`, as bounds on a change of theta (0 where theta is on or beyond its limit).
ThetaBounds room_to_limits(const RobotTable& table, const ThetaVector& theta_rad, double share) noexcept;

// Cholesky factor of a model's curvature; fails never, as a resting model is positive.
struct ShapeFactor {
  std::array<NullVector, kMaxTheta> row;
};
ShapeFactor factor(const NullSpace& space, const ShapeModel& model) noexcept;

// The model's minimum without bounds.
NullVector minimum(const NullSpace& space, const ShapeFactor& factor, const NullVector& pull) noexcept;

// A point of the null space: coordinates and the thetas that they make.
struct NullPoint {
  NullVector z;
  ThetaVector theta_rad;
};

void scale_by(const NullSpace& space, double factor, NullPoint& point) noexcept;

// Thetas that stand on a bound: what restrict_to begins with. Any will do; those of a problem like this one save passes.
struct HeldBounds {
  std::uint32_t low = 0, high = 0;  // bit k: theta k
};

// Moves `point` to where, within bounds, it is nearest in the metric of `factor`, which the curvature makes the minimum of the model;
// without a factor, nearest in theta. Exact by the dual active-set method (D. Goldfarb, A. Idnani, Math. Program. 27, 1983). After `passes`
// changes of the active set without an end, the point is scaled until it is inside, and `held` says where a problem like this one may go
// on.
constexpr std::int32_t kManyPasses = 64;  // enough for any problem of this size
void restrict_to(const NullSpace& space, const ShapeFactor& factor, const ThetaBounds& bounds, std::int32_t passes, HeldBounds& held,
                 NullPoint& point) noexcept;
void restrict_to(const NullSpace& space, const ThetaBounds& bounds, std::int32_t passes, HeldBounds& held, NullPoint& point) noexcept;

}  // namespace liana
