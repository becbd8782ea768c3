#include "host/model/inverse_kinematics/tip_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana::inverse_kinematics {
namespace {

constexpr double kHalfTurn_rad = 180.0 * kDegree;

// The most that one joint turns what lies beyond it: its two axes stand upright on each other.
double most_turn_rad(double limit_rad) {
  const double half = std::cos(0.5 * limit_rad);
  return 2.0 * std::acos(std::min(1.0, half * half));
}

// Whether a flat chain, which began along x and has turned left by `turned_rad` until its end at (x, y), is convex with
// the straight line that closes it: on that line it goes on turning left, at both ends.
bool is_convex(double turned_rad, double x_m, double y_m) {
  double back_rad = std::atan2(-y_m, -x_m);
  if (back_rad < 0.0) back_rad += 2.0 * kHalfTurn_rad;
  return back_rad >= std::max(kHalfTurn_rad, turned_rad) && back_rad <= turned_rad + kHalfTurn_rad;
}

}  // namespace

// Each link points at most as far off the base's x axis as all joints before it turn it. And no chain has its ends
// nearer together than the flat one that is bent by the most at each joint in one sense, while it is convex (Schur's
// comparison theorem; the first joint brings nothing nearer).
TipBounds tip_bounds(const cable::RobotParams& table) noexcept {
  TipBounds bounds;
  double flat_rad = 0.0, along_m = 0.0, across_m = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()) / 2; ++k) {
    const cable::SegmentParams& segment = table.segment[k];
    for (std::int32_t module = 0; module < segment.modules; ++module) {
      const double turn_rad = most_turn_rad(segment.theta_limit_rad);
      if (bounds.turn_rad > 0.0) flat_rad += turn_rad;
      bounds.turn_rad += turn_rad;
      bounds.forward_m += segment.module_length_m * std::cos(std::min(kHalfTurn_rad, bounds.turn_rad));
      along_m += segment.module_length_m * std::cos(flat_rad);
      across_m += segment.module_length_m * std::sin(flat_rad);
    }
  }
  if (is_convex(flat_rad, along_m, across_m)) bounds.nearest_m = std::hypot(along_m, across_m);
  return bounds;
}

}  // namespace liana::inverse_kinematics
