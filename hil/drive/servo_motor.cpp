#include "hil/drive/servo_motor.hpp"

#include <algorithm>
#include <cmath>

namespace liana::bench {

ServoMotor::ServoMotor(double time_constant_s, int pull_direction, double position_counts, bool both_ways)
    : time_constant_s_(time_constant_s),
      pull_direction_(pull_direction),
      both_ways_(both_ways),
      position_(position_counts),
      target_(position_counts) {}

void ServoMotor::set_mode(MotorMode mode) {
  mode_ = mode;
  if (mode == MotorMode::kBraked) velocity_ = 0.0;
}

double ServoMotor::next_velocity(double step_s) const {
  switch (mode_) {
    case MotorMode::kFollow:
      return (target_ - position_) * -std::expm1(-step_s / time_constant_s_) / step_s;
    case MotorMode::kRamp: {
      const double slower = std::max(0.0, std::fabs(velocity_) - deceleration_ * step_s);
      return std::copysign(slower, velocity_);
    }
    case MotorMode::kTorque:
    case MotorMode::kBraked:
      break;
  }
  return 0.0;
}

void ServoMotor::step(double step_s, double torque_permille, double max_torque_permille) {
  if (mode_ == MotorMode::kTorque) return;
  velocity_ = next_velocity(step_s);
  const double turned = both_ways_ && torque_permille < 0.0 ? -1.0 : 1.0;
  limited_ = turned * torque_permille >= max_torque_permille && turned * velocity_ * pull_direction_ > 0.0;
  if (limited_) velocity_ = 0.0;
  position_ += velocity_ * step_s;
}

}  // namespace liana::bench
