// The part of a drive that gives torque (6060 = 10): the loop around its joint torque sensor, and its way to rest.
#include <algorithm>
#include <cmath>

#include "hil/drive/drive.hpp"

namespace liana::bench {

namespace {

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kMilli = 1e-3;

}  // namespace

bool Drive::mode_allows_power() const {
  const std::int64_t mode = objects_.get(0x6061);
  return mode == kCyclicSynchronousPosition || (settings_.is_torque_controlled && mode == kCyclicSynchronousTorque);
}

bool Drive::is_torque_controlled() const { return motor_.mode() == MotorMode::kTorque; }

double Drive::rad_per_count() const { return kTwoPi / (settings_.counts_per_turn * settings_.gear); }

double Drive::Nm_per_permille() const { return kMilli * kMilli * settings_.rated_torque_mNm * settings_.gear; }

TorqueGains Drive::torque_gains() const {
  const auto milli = [this](std::uint8_t sub) { return kMilli * static_cast<double>(objects_.get(0x3001, sub)); };
  return {static_cast<double>(objects_.get(0x3001, 1)), milli(2), milli(3), milli(4), kMilli * milli(5)};
}

double Drive::torque_Nm(double step_s, double gear_Nm, double position_counts, double velocity_counts_per_s) {
  motor_.carry(position_counts, velocity_counts_per_s);
  const double most =
      std::min(static_cast<double>(objects_.get(0x6072)), defects_.most_torque_permille) * Nm_per_permille();
  const GearReading gear{gear_Nm, velocity_counts_per_s * rad_per_count()};
  TorqueGains gains = torque_gains();
  TorqueTarget target;
  if (torque_stop_) {
    gains.drift_per_s = 0.0;  // it would hold the joint where it was
    const auto slow = static_cast<double>(objects_.get(0x3001, 7));
    target.feed_forward_Nm = torque_stop_->step(step_s, std::fabs(velocity_counts_per_s) <= slow);
  } else {
    target.feed_forward_Nm = static_cast<double>(objects_.get(0x6071) + objects_.get(0x60B2)) * Nm_per_permille();
    target.rate_rad_s = static_cast<double>(objects_.get(0x60B1)) * rad_per_count();
  }
  return torque_loop_.step(step_s, gains, target, gear, most);
}

// From Operation enabled the drive ramps down itself; a mode that gives no torque has its own ramp.
void Drive::begin_torque_stop() {
  torque_stop_.emplace(torque_loop_.held_Nm(), kMilli * static_cast<double>(objects_.get(0x3001, 6)));
}

// Position control takes over where the joint is. What 6060 asks for stays: enabled again, the drive is in that mode.
void Drive::end_torque() {
  torque_stop_.reset();
  torque_loop_.reset();
  sample();
  objects_.set(0x607A, 0, objects_.get(0x6064));
  objects_.set(0x6061, 0, kCyclicSynchronousPosition);
}

bool Drive::is_at_rest() const {
  return is_torque_controlled() ? torque_stop_ && torque_stop_->done() : motor_.velocity_counts_per_s() == 0.0;
}

}  // namespace liana::bench
