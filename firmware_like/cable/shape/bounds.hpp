// Bounds on the thetas of a vector in the null space: joint limits, seen from where the arm stands.
#pragma once

#include <cstdint>

#include "firmware_like/cable/shape/shape_model.hpp"

namespace liana::cable {

struct ThetaBounds {
  ThetaVector low;   // <= 0
  ThetaVector high;  // >= 0
};

// Room to the joint limits divided by `share`, as bounds on a change of theta (0 where theta is on or beyond its
// limit).
ThetaBounds room_to_limits(const RobotParams& table, const ThetaVector& theta_rad, double share) noexcept;

// A point of the null space: coordinates and the thetas that they make.
struct NullPoint {
  NullVector z;
  ThetaVector theta_rad;
};

void scale_by(const NullSpace& space, double factor, NullPoint& point) noexcept;

// Thetas that stand on a bound: what restrict_to begins with. Any will do; those of a problem like this one save
// passes.
struct HeldBounds {
  std::uint32_t low = 0, high = 0;  // bit k: theta k
};

// Moves `point` to where, within bounds, it is nearest in the metric of `factor`, which the curvature makes the minimum
// of the model; without a factor, nearest in theta. Exact by the dual active-set method (D. Goldfarb, A. Idnani, Math.
// Program. 27, 1983). After `passes` changes of the active set without an end, the point is scaled until it is inside,
// and `held` says where a problem like this one may go on.
constexpr std::int32_t kManyPasses = 64;  // enough for any problem of this size
void restrict_to(const NullSpace& space, const ShapeFactor& factor, const ThetaBounds& bounds, std::int32_t passes,
                 HeldBounds& held, NullPoint& point) noexcept;
void restrict_to(const NullSpace& space, const ThetaBounds& bounds, std::int32_t passes, HeldBounds& held,
                 NullPoint& point) noexcept;

}  // namespace liana::cable
