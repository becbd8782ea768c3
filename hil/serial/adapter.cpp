#include "hil/serial/adapter.hpp"

#include <cmath>

namespace liana::bench {

Vec3 Adapter::place_on_circle(std::size_t pin) const {
  const double angle = 2.0 * 3.14159265358979323846 * static_cast<double>(pin) / kPins;
  return {figures_.circle_m * std::cos(angle), figures_.circle_m * std::sin(angle), 0.0};
}

PinState Adapter::pin_of(std::size_t pin, const TipState& plate) const {
  const Vec3 arm = rotate(plate.pose.attitude, place_on_circle(pin));
  return {plate.pose.position_m + arm - place_on_circle(pin), plate.velocity_m_s + cross(plate.rate_rad_s, arm)};
}

TipLoad Adapter::push(const TipState& plate) const {
  TipLoad load;
  for (std::size_t i = 0; i < kPins; ++i) {
    const PinState pin = pin_of(i, plate);
    Vec3 force = pin_force_N(figures_, defects_[i], pin);
    if (latched_at_m_) force.z += latch_force_N(figures_, (*latched_at_m_)[i], pin);
    load.force_N = load.force_N + force;
    load.torque_Nm = load.torque_Nm + cross(rotate(plate.pose.attitude, place_on_circle(i)), force);
  }
  return load;
}

void Adapter::step(double step_s, const TipState& plate) {
  PinValues true_m{};
  for (std::size_t i = 0; i < kPins; ++i) {
    true_m[i] = pin_of(i, plate).at_m.z;
    depth_m_[i] = defects_[i].reads_m.value_or(true_m[i]);
  }
  const bool was_captured = logic_.captured();
  if (logic_.step(step_s, depth_m_) && !was_captured && latch_works_) latched_at_m_ = true_m;
}

void Adapter::release() {
  latched_at_m_.reset();
  logic_ = {};
}

}  // namespace liana::bench
