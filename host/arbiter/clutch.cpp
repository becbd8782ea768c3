#include "host/arbiter/clutch.hpp"

namespace liana::arbiter {

Vec3 clutch_point(double scale_factor, const Vec3& hand_anchor_m, const Vec3& point_anchor_m, const Vec3& hand_m) {
  return add(point_anchor_m, scale(subtract(hand_m, hand_anchor_m), scale_factor));
}

Pose clutch_goal(const ClutchMapping& mapping, const ClutchAnchor& anchor, const Pose& hand) {
  const Vec3 turn = rotation_vector(multiply(hand.quaternion, conjugate(anchor.hand_in_device.quaternion)));
  const Quat turned = quaternion_of(scale(turn, mapping.rotation_scale));
  return {clutch_point(mapping.scale, anchor.hand_in_device.position_m, anchor.tip_in_base.position_m, hand.position_m),
          normalize(multiply(turned, anchor.tip_in_base.quaternion))};
}

}  // namespace liana::arbiter
