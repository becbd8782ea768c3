#include "hil/payload/payload_site.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace liana::bench {

BodyConfig moved_body(const Pose& pose, const BodyConfig& body) {
  const auto& [xx, yy, zz, xy, xz, yz] = body.inertia_kgm2;
  const Vec3 rows[3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
  const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto turned = [&](std::size_t a, std::size_t b) {  // a^T R T R^T b
    const Vec3 left = rotate(conjugate(pose.attitude), unit[a]), right = rotate(conjugate(pose.attitude), unit[b]);
    return dot(left, {dot(rows[0], right), dot(rows[1], right), dot(rows[2], right)});
  };
  return {body.mass_kg,
          pose.position_m + rotate(pose.attitude, body.center_m),
          {turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(0, 2), turned(1, 2)}};
}

PayloadSite::PayloadSite(const PayloadConfig& payload, const Pose& socket, const AdapterParams& figures)
    : payload_(payload),
      socket_(socket),
      adapter_(figures),
      holder_(payload.on_arm ? Holder::kArm : Holder::kMechanism),
      held_at_(payload.pose) {}

Pose PayloadSite::payload(const Pose& tip) const { return holder_ == Holder::kArm ? compose(tip, grip_) : held_at_; }

Pose PayloadSite::plate(const Pose& tip) const { return compose(payload(tip), {{0.0, 0.0, payload_.length_m}, {}}); }

TipState PayloadSite::plate_state(const TipState& tip) const {
  const Pose pose = plate_in_socket(tip.pose);
  if (holder_ != Holder::kArm) return {pose, {}, {}};
  const Quat into = conjugate(socket_.attitude);
  const Vec3 arm = plate(tip.pose).position_m - tip.pose.position_m;
  return {pose, rotate(into, tip.velocity_m_s + cross(tip.rate_rad_s, arm)), rotate(into, tip.rate_rad_s)};
}

// It only pushes back, along the grapple's axis, a tip that is past its face.
TipLoad PayloadSite::push_on_grapple(const TipState& tip) const {
  const Vec3 at = relative(held_at_, tip.pose).position_m;
  if (at.z <= 0.0 || std::hypot(at.x, at.y) > kGrappleRadius_m) return {};
  const Vec3 axis = rotate(held_at_.attitude, {0.0, 0.0, 1.0});
  const double press = std::max(0.0, kGrappleStiffness_N_m * at.z + kGrappleDamping_Ns_m * dot(axis, tip.velocity_m_s));
  return {-press * axis, {}};
}

TipLoad PayloadSite::adapter_load(const TipState& tip) const {
  return holder_ == Holder::kArm ? adapter_.push(plate_state(tip)) : TipLoad{};
}

TipLoad PayloadSite::push(const TipState& tip) const {
  if (holder_ == Holder::kMechanism) return push_on_grapple(tip);
  const TipLoad load = adapter_load(tip);
  const Vec3 force = rotate(socket_.attitude, load.force_N), torque = rotate(socket_.attitude, load.torque_Nm);
  return {force, torque + cross(plate(tip.pose).position_m - tip.pose.position_m, force)};
}

void PayloadSite::step(double step_s, const TipState& tip) { adapter_.step(step_s, plate_state(tip)); }

BodyConfig PayloadSite::take(const Pose& tip) {
  grip_ = relative(tip, payload(tip));
  holder_ = Holder::kArm;
  return moved_body(grip_, payload_.body);
}

void PayloadSite::let_go(const Pose& tip) {
  held_at_ = payload(tip);
  holder_ = Holder::kAdapter;
}

void PayloadSite::shift(const Vec3& by_m) {
  socket_.position_m = socket_.position_m + by_m;
  held_at_.position_m = held_at_.position_m + by_m;
}

}  // namespace liana::bench
