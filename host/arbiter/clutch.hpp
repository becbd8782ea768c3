// From hand motion to tip motion: P_r = a P_m, counted from the pose where the operator engaged (mission, C2).
#pragma once

#include "firmware_like/math/pose.hpp"

namespace liana::arbiter {

// How hand motion maps to tip motion.
struct ClutchMapping {
  double scale = 1.0;           // tip metres per hand metre, > 0
  double rotation_scale = 1.0;  // tip angle per hand angle, >= 0
};

// Where hand and tip stood when the operator engaged.
struct ClutchAnchor {
  Pose hand_in_device{};
  Pose tip_in_base{};
};

// Tip goal in the base frame for a hand pose. At the anchor it is exactly the anchored tip pose, so that engaging never
// jumps. The device frame is parallel to the base frame.
Pose clutch_goal(const ClutchMapping& mapping, const ClutchAnchor& anchor, const Pose& hand_in_device);

// The same for a point (node control, left VR hand): only translation counts.
Vec3 clutch_point(double scale, const Vec3& hand_anchor_m, const Vec3& point_anchor_m, const Vec3& hand_m);

}  // namespace liana::arbiter
