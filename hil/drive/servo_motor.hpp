// Motor, position servo and brake of one drive, in encoder counts.
#pragma once

namespace liana::bench {

enum class MotorMode { kBraked, kFollow, kRamp, kTorque };

class ServoMotor {
 public:
  // `pull_direction` is the sign of counts that winds cable up, against the load.
  // `both_ways`: a load below 0 is one the other way.
  ServoMotor(double time_constant_s, int pull_direction, double position_counts, bool both_ways = false);

  // One step; `torque_permille` is the load now. At `max_torque_permille` the servo gives no more: it stops winding up,
  // or going on against the load.
  void step(double step_s, double torque_permille, double max_torque_permille);

  void set_mode(MotorMode mode);
  void set_target(double counts) { target_ = counts; }
  // In mode kTorque the physics behind the motor say where it is.
  void carry(double counts, double counts_per_s) {
    position_ = counts;
    velocity_ = counts_per_s;
  }
  void set_deceleration(double counts_per_s2) { deceleration_ = counts_per_s2; }

  MotorMode mode() const { return mode_; }
  double position_counts() const { return position_; }
  double velocity_counts_per_s() const { return velocity_; }
  bool at_torque_limit() const { return limited_; }

 private:
  double next_velocity(double step_s) const;

  double time_constant_s_;
  int pull_direction_;
  bool both_ways_;
  double position_;
  double target_;
  double velocity_ = 0.0;
  double deceleration_ = 1e6;
  MotorMode mode_ = MotorMode::kBraked;
  bool limited_ = false;
};

}  // namespace liana::bench
