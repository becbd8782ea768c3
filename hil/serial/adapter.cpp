#include "hil/serial/adapter.hpp"

#include <algorithm>
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
    if (latched_at_m_) force.z += latch_force_N(figures_, (*latched_at_m_)[i] + drawn_in_m_, pin);
    load.force_N = load.force_N + force;
    load.torque_Nm = load.torque_Nm + cross(rotate(plate.pose.attitude, place_on_circle(i)), force);
  }
  return load;
}

void Adapter::step(double step_s, const TipState& plate) {
  PinValues true_m{};
  for (std::size_t i = 0; i < kPins; ++i) {
    const PinState pin = pin_of(i, plate);
    true_m[i] = is_over_body(figures_, pin) ? pin.at_m.z : std::min(pin.at_m.z, 0.0);
    depth_m_[i] = defects_[i].reads_m.value_or(true_m[i]);
  }
  logic_.step(step_s, depth_m_);
  move_latch(step_s, true_m);
  move_lock(step_s);
}

void Adapter::move_latch(double step_s, const PinValues& true_m) {
  if (!logic_.captured() || latched()) return;
  latching_s_ += step_s;
  if (latch_works_ && latching_s_ >= figures_.latch_s) {
    latched_at_m_ = true_m;
    latch_ = Closure::kClosed;
    return;
  }
  latch_ = latching_s_ < figures_.latch_s + figures_.give_up_s ? Closure::kClosing : Closure::kFailed;
}

void Adapter::begin_lock() {
  if (!latched() || lock_ == Closure::kClosed) return;
  lock_ = Closure::kClosing;
  locking_s_ = 0.0;
}

void Adapter::move_lock(double step_s) {
  if (lock_ != Closure::kClosing) return;
  locking_s_ += step_s;
  const double reach_m = lock_works_ ? figures_.lock_m : std::max(drawn_in_m_, 0.5 * figures_.lock_m);
  drawn_in_m_ = std::min(reach_m, drawn_in_m_ + figures_.lock_m_s * step_s);
  if (drawn_in_m_ >= figures_.lock_m)
    lock_ = Closure::kClosed;
  else if (locking_s_ > figures_.lock_m / figures_.lock_m_s + figures_.give_up_s)
    lock_ = Closure::kFailed;
}

void Adapter::release() {
  latched_at_m_.reset();
  logic_ = {};
  latch_ = lock_ = Closure::kOpen;
  latching_s_ = drawn_in_m_ = 0.0;
}

}  // namespace liana::bench
