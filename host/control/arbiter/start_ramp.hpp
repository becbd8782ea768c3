// How a cable arm gets going: as it may swing.
#pragma once

#include <algorithm>

namespace liana::arbiter {

// Friction holds a cable arm until the command is some millimetres ahead; then it swings after it. Asked for 27 mm/s at
// once the true tip reaches 42; with a ramp of 12 mm/s2 and 26 mm/s at its end 32.7; with one that ends gently 29.9.
class StartRamp {
 public:
  // Once per command interval of `dt_s`, with the speed at which the command has gone in it.
  void note(double speed_m_s, double dt_s) {
    speed_m_s_ = speed_m_s < kStands_m_s ? kFirst_m_s : std::min(speed_m_s_ + ramp_m_s2() * dt_s, kMost_m_s);
  }
  // Highest speed to ask for now [m/s].
  double speed_m_s() const { return speed_m_s_; }

 private:
  static constexpr double kStands_m_s = 0.003;  // slower is standing: a hand that holds still trembles
  static constexpr double kFirst_m_s = 0.005;
  static constexpr double kRamp_m_s2 = 0.012;
  static constexpr double kGentleFrom_m_s = 0.018;
  static constexpr double kGentle_m_s2 = 0.005;
  static constexpr double kMost_m_s = 1.0;  // faster than any tip

  double ramp_m_s2() const { return speed_m_s_ < kGentleFrom_m_s ? kRamp_m_s2 : kGentle_m_s2; }

  double speed_m_s_ = kFirst_m_s;
};

// How fast the tip goes after a goal that was set far ahead of it. At the limit's own acceleration, 0.22 m/s2, the true
// tip swings to 1.33 times its limit, on long poses that swing once in a second; with less than half of that it swings
// half as far, and comes to full speed in about one swing. What corners swing takes a fifth of the limit.
class GoalRamp {
 public:
  GoalRamp(double accel_m_s2, double max_m_s) : accel_m_s2_(accel_m_s2), max_m_s_(max_m_s) {}
  // Once per command interval of `dt_s`, with the speed at which the command has gone in it.
  void note(double speed_m_s, double dt_s) {
    speed_m_s_ = std::clamp(speed_m_s_ + accel_m_s2_ * dt_s, speed_m_s, speed_m_s + accel_m_s2_ * kAhead_s);
  }
  // Highest speed to ask for now [m/s].
  double speed_m_s() const { return std::min(speed_m_s_, max_m_s_); }

 private:
  static constexpr double kAhead_s = 0.2;

  double accel_m_s2_, max_m_s_;
  double speed_m_s_ = 0.0;
};

}  // namespace liana::arbiter
