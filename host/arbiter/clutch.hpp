// From hand motion to tip motion: P_r = a P_m, counted from the pose where the operator engaged (mission, C2).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "firmware_like/math/pose.hpp"

namespace liana::arbiter {

// Whose axes the hand's axes are: the base's; the tip's as it stood when the operator engaged; those of the tip camera,
// which turn with the tip as it is led.
enum class SteerFrame : std::uint8_t { kBase = 0, kTip = 1, kCamera = 2 };
constexpr std::array<const char*, 3> kFrameNames{"base", "tip", "camera"};
constexpr const char* name_of(SteerFrame frame) { return kFrameNames[static_cast<std::size_t>(frame)]; }
// The frame of a name, which has to be one of kFrameNames.
SteerFrame frame_of(std::string_view name);

// How hand motion maps to tip motion.
struct ClutchMapping {
  double scale = 1.0;           // tip metres per hand metre, > 0
  double rotation_scale = 1.0;  // tip angle per hand angle, >= 0
  SteerFrame frame = SteerFrame::kBase;

  bool operator==(const ClutchMapping&) const = default;
};

// Where hand and tip stood when the operator engaged.
struct ClutchAnchor {
  Pose hand_in_device{};
  Pose tip_in_base{};
};

// Tip goal in the base frame for a hand pose. At the anchor it is exactly the anchored tip pose, so that engaging never
// jumps. The device frame is parallel to the base frame, or to the anchored tip's: what turns the camera's axes is that
// whoever steers by them moves the anchor along (move_anchor).
Pose clutch_goal(const ClutchMapping& mapping, const ClutchAnchor& anchor, const Pose& hand_in_device);

// The anchor for the next hand pose, after `goal` was asked for with `hand_in_device`: moved there where the axes are
// the camera's, else as it is.
void move_anchor(const ClutchMapping& mapping, const Pose& hand_in_device, const Pose& goal, ClutchAnchor& anchor);

// The same for a point in the base's axes (node control, left VR hand): only translation counts.
Vec3 clutch_point(double scale, const Vec3& hand_anchor_m, const Vec3& point_anchor_m, const Vec3& hand_m);

}  // namespace liana::arbiter
