#include "host/operator/simulated/leg.hpp"

#include <algorithm>
#include <cmath>

namespace liana::simulated {

namespace {
constexpr double kArrived_m = 1e-5;  // closer than this a leg ends, or braking would creep for ever
}

Leg::Leg(const Pose& from, const Pose& to, const LegPace& pace)
    : start_(from), goal_(to), whole_(step_between(from, to)), pace_(pace) {
  const double turn_worth_m = norm(whole_.turn_rad) / pace.turn_rate_rad_s * pace.speed_m_s;
  length_m_ = std::max(norm(whole_.shift_m), turn_worth_m);
}

double Leg::speed_limit() const {
  const double left_m = length_m_ - walked_m_;
  const double stop = std::sqrt(2.0 * pace_.accel_m_s2 * left_m);
  const double until_slow_m = std::max(0.0, pace_.slow_from_x_m - pose().position_m[0]);
  const double slow_down =
      std::sqrt(pace_.slow_speed_m_s * pace_.slow_speed_m_s + 2.0 * pace_.accel_m_s2 * until_slow_m);
  return std::min({pace_.speed_m_s, stop, slow_down});
}

void Leg::walk(double dt_s, double eagerness) {
  if (finished()) {
    speed_m_s_ = 0.0;
    return;
  }
  const double wanted = speed_limit() * std::clamp(eagerness, 0.0, 1.0);
  const double change = pace_.accel_m_s2 * dt_s;
  speed_m_s_ = std::min(std::clamp(wanted, speed_m_s_ - change, speed_m_s_ + change), speed_limit());
  walked_m_ = std::min(length_m_, walked_m_ + speed_m_s_ * dt_s);
  if (length_m_ - walked_m_ < kArrived_m) walked_m_ = length_m_;
}

Pose Leg::pose() const { return moved(start_, {scale(whole_.shift_m, share()), scale(whole_.turn_rad, share())}); }

PoseStep Leg::remaining() const { return step_between(pose(), goal_); }

}  // namespace liana::simulated
