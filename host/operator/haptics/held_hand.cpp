#include "host/operator/haptics/held_hand.hpp"

#include <algorithm>
#include <cmath>

namespace liana::haptics {
namespace {

// From the device's own axes to those parallel to the base: its x is the base's y.
const Quat kMounted{std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};

Quat in_own_axes(const Quat& q) { return multiply(multiply(conjugate(kMounted), q), kMounted); }
Quat in_base_axes(const Quat& q) { return multiply(multiply(kMounted, q), conjugate(kMounted)); }

// The wrist's angles for an attitude, as omega.cpp turns them: about x, then the turned y, then the turned z.
Vec3 wrist_of(const Quat& q) {
  const Vec3 x = rotate(q, {1.0, 0.0, 0.0}), y = rotate(q, {0.0, 1.0, 0.0}), z = rotate(q, {0.0, 0.0, 1.0});
  return {std::atan2(-z[1], z[2]), std::asin(std::clamp(z[0], -1.0, 1.0)), std::atan2(-y[0], x[0])};
}

Intent intent_of(const device::Sample& wish) {
  return {rotate(conjugate(kMounted), wish.pose.position_m), wrist_of(in_own_axes(wish.pose.quaternion)), wish.deadman};
}

}  // namespace

HeldHand::HeldHand(const HandLoopTable& loop, const HandParams& hand, std::uint64_t seed)
    : omega_(OmegaTable{}, hand, {}, seed), loop_(loop) {}

device::Sample HeldHand::step(const device::Sample& wish, const Vec3& commanded_m) noexcept {
  device::Sample sensed = omega_.sample();
  sensed.t_us = wish.t_us;
  sensed.pose = {rotate(kMounted, sensed.pose.position_m), in_base_axes(sensed.pose.quaternion)};
  force_ = loop_.step(sensed, commanded_m);
  omega_.step(rotate(conjugate(kMounted), force_.force_N), intent_of(wish));
  peak_force_N_ = std::max(peak_force_N_, norm(force_.force_N));
  min_energy_J_ = std::min(min_energy_J_, omega_.absorbed_J());
  return sensed;
}

}  // namespace liana::haptics
