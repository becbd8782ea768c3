// The distance of an arm from itself. Exact; pairs of links that cannot be the least are not measured.
#pragma once

#include "host/model/clearance/clearance.hpp"

namespace liana::clearance {

// Distance between the surfaces of two capsules; negative: overlap along the shortest line between their axes, at most
// both radii. About 140 instructions.
double between_m(const Capsule& a, const Capsule& b) noexcept;

// The least distance between two links of one arm.
struct SelfClearance {
  double nearest_m = kNoObstacle_m;
  std::int32_t link = -1;   // the one nearer to the base; -1: no two links count
  std::int32_t other = -1;  // the one nearer to the tip

  double distance_m() const { return nearest_m; }
};

// Of all pairs of links with numbers that differ by `min_apart` (>= 2) or more the least; on equal distances the pair
// with the first link, then the first other, wins. The bits are those of measuring all of them. An arm with a point
// that is no number is -kNoObstacle_m from itself. Any number of links; cost with 40 links: 16,000 instructions in the
// median, 31,000 at worst.
SelfClearance self_clearance(AxisPoints points, double radius_m, std::int32_t min_apart) noexcept;

// How far links have to be apart along the arm before they can touch: joints that can bend by half a turn together
// when each of them bends by at most `joint_limit_rad` (> 0) about both its axes.
std::int32_t min_apart(double joint_limit_rad) noexcept;

}  // namespace liana::clearance
