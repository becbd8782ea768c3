// Where a tracker stands and where its marker sits on the tip, from tip poses by kinematics and by the tracker:
// marker_in_tracker = base_in_tracker * tip_in_base * marker_in_tip in every pose.
//
// Source: Shah 2013 (doi 10.1115/1.4024473): rotations by a null space, then positions by least squares.
#pragma once

#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::calibration {

struct HandEye {
  Pose base_in_tracker{};
  Pose marker_in_tip{};

  Pose marker_in_tracker(const Pose& tip_in_base) const {
    return compose(compose(base_in_tracker, tip_in_base), marker_in_tip);
  }
};

// Both lists are of the same poses, in the same order. Throws std::runtime_error when they turn the tip about one axis
// only: then some of it may be anything.
HandEye hand_eye(const std::vector<Pose>& tip_in_base, const std::vector<Pose>& marker_in_tracker);

}  // namespace liana::calibration
