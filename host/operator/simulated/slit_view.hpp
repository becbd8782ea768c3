// What the person at the hand controller sees and knows: the tip camera's picture and the drawing of the scene.
#pragma once

#include <optional>

#include "firmware_like/math/pose.hpp"

namespace liana::simulated {

// One picture of the tip camera (docs/reference/api.md): frames as seen from the tip; nothing when out of sight.
struct TipObservation {
  std::optional<Pose> slit;
  std::optional<Pose> rod;
};

// The drawing: where the slit frame is in the base frame (turns hand directions), and where the rod is in the slit
// frame.
struct SlitModel {
  Pose slit_in_base{};
  Pose rod_in_slit{};
};

// Drawing from the slit and rod poses in the base frame.
SlitModel slit_drawing(const Pose& slit_in_base, const Pose& rod_in_base);

// Tip pose in the slit frame, from the rod when `by_rod` and it is in sight, else from the slit; nothing when neither
// is in sight.
std::optional<Pose> tip_in_slit(const SlitModel& drawing, const TipObservation& sighting, bool by_rod);

// Position [m] and rotation vector [rad] that lead from pose `from` to pose `to`, in the frame both are given in.
struct PoseStep {
  Vec3 shift_m{};
  Vec3 turn_rad{};
};
PoseStep step_between(const Pose& from, const Pose& to);

// `pose` moved by `step`: the turn is applied in the outer frame.
Pose moved(const Pose& pose, const PoseStep& step);

}  // namespace liana::simulated
