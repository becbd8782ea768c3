// What a display shows of the arm: its axis as it is drawn, and where its tip is. No joint angle, no force.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::simulated {

// One picture of the arm, base frame.
struct ArmObservation {
  Pose tip{};
  std::vector<Vec3> axis_m;    // drawn axis, from the root to the tip; empty: nothing is shown
  std::size_t node_point = 0;  // the point of it that the left hand leads
  double radius_m = 0.0;       // as thick as it is drawn

  const Vec3& node_m() const { return axis_m[node_point]; }
};

}  // namespace liana::simulated
