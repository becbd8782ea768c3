// From hand motion to tip motion: P_r = a P_m, counted from the pose where the operator engaged (mission, C2).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "firmware_like/math/pose.hpp"

namespace liana::arbiter {

// Whose axes the hand's axes are: the base's; the tip's as it stood when the operator engaged; those of the tip camera,
// which turn with the tip as it is led.
enum class TeleopFrame : std::uint8_t { kBase = 0, kTip = 1, kCamera = 2 };
constexpr std::array<const char*, 3> kFrameNames{"base", "tip", "camera"};
constexpr const char* name_of(TeleopFrame frame) { return kFrameNames[static_cast<std::size_t>(frame)]; }
// The frame of a name, which has to be one of kFrameNames.
TeleopFrame frame_of(std::string_view name);

// How hand motion maps to tip motion.
struct ClutchMapping {
  double scale = 1.0;           // tip metres per hand metre, > 0
  double rotation_scale = 1.0;  // tip angle per hand angle, >= 0
  TeleopFrame frame = TeleopFrame::kBase;

  bool operator==(const ClutchMapping&) const = default;
};

// Where hand and tip stood when the operator engaged; with the camera's axes: at the last pose.
struct ClutchAnchor {
  Pose hand_in_device{};
  Pose tip_in_base{};
};

// The goal's attitude is at most so far from the commanded one: the arm takes the shorter way between the two, and
// beyond half a turn that would be the wrong one.
constexpr double kMaxLead_rad = 1.57;
// What the hand has turned ahead of that is kept up to a turn, and made up for as the tip comes; more is lost.
constexpr double kMaxOwed_rad = 6.28;

// The hand that leads the tip. The way counts from the anchor; turns are counted on from pose to pose, so that a hand
// may turn as often as it likes in one grip.
class Clutch {
 public:
  // The deadman closes: hand and tip stand so. At the anchor the goal is exactly the tip's pose.
  void engage(const Pose& hand_in_device, const Pose& tip_in_base);
  // Tip goal in the base frame for the next hand pose, less than half a turn from the one before; `commanded` is where
  // the tip is commanded to be. The device frame is parallel to the frame of the mapping.
  Pose follow(const ClutchMapping& mapping, const Pose& hand_in_device, const Pose& commanded);
  const ClutchAnchor& anchor() const { return anchor_; }

 private:
  void turn_on(const Vec3& turn_rad, const Quat& commanded);

  ClutchAnchor anchor_{};
  Quat hand_{1.0, 0.0, 0.0, 0.0};  // newest attitude
  Quat axes_{1.0, 0.0, 0.0, 0.0};  // of the tip, where they count
  Quat goal_{1.0, 0.0, 0.0, 0.0};  // asked for last
  Vec3 owed_rad_{};                // turned by the hand, and not asked for yet; base frame
};

// The same for a point in the base's axes (node control, left VR hand): only translation counts.
Vec3 clutch_point(double scale, const Vec3& hand_anchor_m, const Vec3& point_anchor_m, const Vec3& hand_m);

}  // namespace liana::arbiter
