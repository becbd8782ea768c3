// How fast a hand may lead a cable arm while one of its cables is on its way to slack.
#pragma once

#include <algorithm>
#include <cstddef>

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::arbiter {

// Friction of a long bend holds the arm behind its command, and a cable that is paid out then loses its tension faster
// than the core winds it in: 100 N/s at 6 mm/s of the tip, with all angles near their limits. A hand that waits for the
// cable keeps it taut; planned motions would sway by it, and be refused. By the measured tension at the motor, and by
// where it is going.
class TautPace {
 public:
  static constexpr double kLeast = 0.02;  // of the speed: who waits for ever is not told why

  // `table` has to outlive this.
  TautPace(const cable::RobotParams& table, double interval_s)
      : limits_(table.tension),
        first_(static_cast<std::size_t>(table.feed_count())),
        count_(static_cast<std::size_t>(table.cable_count())),
        interval_s_(interval_s) {}

  // Once per command interval, with the tensions at the motors: the share of its speed that motion has in it.
  double next(const cable::CableVector& tension_N) {
    double least_N = limits_.plan_N;
    for (std::size_t c = first_; c < count_; ++c) {
      const double fall_N_s = has_begun_ ? std::min(0.0, (tension_N[c] - before_N_[c]) / interval_s_) : 0.0;
      least_N = std::min(least_N, tension_N[c] + kAhead_s * fall_N_s);
    }
    before_N_ = tension_N;
    has_begun_ = true;
    const double over_N = (least_N - limits_.floor_motor_N) / limits_.scale();
    const double left = std::clamp((over_N - kStands_N) / (kFree_N - kStands_N), kLeast, 1.0);
    return share_ = std::clamp(left, share_ - kChange_1_s * interval_s_, share_ + kChange_1_s * interval_s_);
  }
  void forget() { share_ = 1.0, has_begun_ = false; }

 private:
  static constexpr double kFree_N = 3.0, kStands_N = -6.0;  // over the floor, of an arm that plans 40 N
  static constexpr double kAhead_s = 0.08;
  static constexpr double kChange_1_s = 4.0;  // as planned motions come to rest

  const cable::TensionLimits& limits_;
  std::size_t first_, count_;
  double interval_s_;
  cable::CableVector before_N_{};
  double share_ = 1.0;
  bool has_begun_ = false;
};

}  // namespace liana::arbiter
