#include "host/control/arbiter/clutch.hpp"

#include <algorithm>

namespace liana::arbiter {

namespace {

double turn_between(const Quat& a, const Quat& b) { return norm(rotation_vector(multiply(a, conjugate(b)))); }

Vec3 no_longer(const Vec3& v, double most) {
  const double length = norm(v);
  return length > most ? scale(v, most / length) : v;
}

}  // namespace

Vec3 clutch_point(double scale_factor, const Vec3& hand_anchor_m, const Vec3& point_anchor_m, const Vec3& hand_m) {
  return add(point_anchor_m, scale(subtract(hand_m, hand_anchor_m), scale_factor));
}

TeleopFrame frame_of(std::string_view name) {
  return static_cast<TeleopFrame>(std::ranges::find(kFrameNames, name) - kFrameNames.begin());
}

void Clutch::engage(const Pose& hand, const Pose& tip) {
  anchor_ = {hand, tip};
  hand_ = hand.quaternion;
  axes_ = goal_ = tip.quaternion;
  owed_rad_ = {};
}

Pose Clutch::follow(const ClutchMapping& mapping, const Pose& hand, const Pose& commanded) {
  const Quat axes = mapping.frame == TeleopFrame::kBase ? Quat{1.0, 0.0, 0.0, 0.0} : axes_;
  const Vec3 way_m = subtract(hand.position_m, anchor_.hand_in_device.position_m);
  const Vec3 turn_rad = rotation_vector(multiply(hand.quaternion, conjugate(hand_)));
  hand_ = hand.quaternion;
  turn_on(scale(rotate(axes, turn_rad), mapping.rotation_scale), commanded.quaternion);
  const Pose goal{add(anchor_.tip_in_base.position_m, scale(rotate(axes, way_m), mapping.scale)), goal_};
  if (mapping.frame == TeleopFrame::kCamera) {
    anchor_ = {hand, goal};
    axes_ = goal_;
  }
  return goal;
}

// From a lead within the limit no step of less than half a turn comes out on the other side of the tip; one that leads
// farther than before is shortened.
void Clutch::turn_on(const Vec3& turn_rad, const Quat& commanded) {
  owed_rad_ = no_longer(add(owed_rad_, turn_rad), kMaxOwed_rad);
  const double lead_rad = turn_between(goal_, commanded);
  const auto turned = [this](const Vec3& step_rad) { return normalize(multiply(quaternion_of(step_rad), goal_)); };
  Vec3 step_rad = no_longer(owed_rad_, kMaxLead_rad);
  if (turn_between(turned(step_rad), commanded) > std::max(kMaxLead_rad, lead_rad))
    step_rad = no_longer(step_rad, std::max(0.0, kMaxLead_rad - lead_rad));
  goal_ = turned(step_rad);
  owed_rad_ = subtract(owed_rad_, step_rad);
}

}  // namespace liana::arbiter
