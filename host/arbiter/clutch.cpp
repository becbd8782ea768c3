#include "host/arbiter/clutch.hpp"

#include <algorithm>

namespace liana::arbiter {

Vec3 clutch_point(double scale_factor, const Vec3& hand_anchor_m, const Vec3& point_anchor_m, const Vec3& hand_m) {
  return add(point_anchor_m, scale(subtract(hand_m, hand_anchor_m), scale_factor));
}

SteerFrame frame_of(std::string_view name) {
  return static_cast<SteerFrame>(std::ranges::find(kFrameNames, name) - kFrameNames.begin());
}

Pose clutch_goal(const ClutchMapping& mapping, const ClutchAnchor& anchor, const Pose& hand) {
  const Quat device_in_base =
      mapping.frame == SteerFrame::kBase ? Quat{1.0, 0.0, 0.0, 0.0} : anchor.tip_in_base.quaternion;
  const Vec3 way_m = subtract(hand.position_m, anchor.hand_in_device.position_m);
  const Vec3 turn = rotation_vector(multiply(hand.quaternion, conjugate(anchor.hand_in_device.quaternion)));
  const Quat turned = quaternion_of(scale(rotate(device_in_base, turn), mapping.rotation_scale));
  return {add(anchor.tip_in_base.position_m, scale(rotate(device_in_base, way_m), mapping.scale)),
          normalize(multiply(turned, anchor.tip_in_base.quaternion))};
}

void move_anchor(const ClutchMapping& mapping, const Pose& hand, const Pose& goal, ClutchAnchor& anchor) {
  if (mapping.frame == SteerFrame::kCamera) anchor = {hand, goal};
}

}  // namespace liana::arbiter
