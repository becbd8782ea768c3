// How fast the tip may be led while the arm has yet to come after it.
#pragma once

#include <algorithm>
#include <cmath>

#include "firmware_like/math/pose.hpp"

namespace liana::arbiter {

// Friction holds a cable arm until its command is some millimetres ahead; then it sways after it, faster than it is
// led. A lag d that changes with d' sways the tip by hypot(w d, d') about the command's speed, w that of the sway. So
// much is kept free under the tip's limit, along the way that is asked for. What the arm lags by all the time, by
// friction and errors of the table, makes no sway: it is taken off. Besides, kFreeShare of the limit is kept free:
// nominal arms led straight at nearly their limit were up to 1.28 times as fast as their command.
class CatchUp {
 public:
  explicit CatchUp(double interval_s) : interval_s_(interval_s) {}

  // Once per command interval: where the tip is commanded to be, and where it is measured.
  void note(const Vec3& command_m, const Vec3& measured_m) {
    const Vec3 lag_m = subtract(command_m, measured_m);
    if (!has_begun_) standing_m_ = lag_m_ = lag_m;
    has_begun_ = true;
    standing_m_ = add(standing_m_, scale(subtract(lag_m, standing_m_), interval_s_ / kStanding_s));
    const Vec3 rate_m_s = scale(subtract(lag_m, lag_m_), 1.0 / interval_s_);
    rate_m_s_ = add(rate_m_s_, scale(subtract(rate_m_s, rate_m_s_), interval_s_ / (kRate_s + interval_s_)));
    lag_m_ = lag_m;
    before_m_s_ = left_m_s_;
  }
  // Of `limit_m_s`, what a tip that is led along `way_m` in this interval may have: it falls slowly, for a command that
  // brakes hard sways the arm, too. 0 at least.
  double speed_m_s(const Vec3& way_m, double limit_m_s) {
    const double way = norm(way_m);
    const double max_m_s = (1.0 - kFreeShare) * limit_m_s;
    if (!(way > 0.0)) return max_m_s;
    const Vec3 along = scale(way_m, 1.0 / way);
    const double behind_m = dot(subtract(lag_m_, standing_m_), along), comes_m_s = std::min(0.0, dot(rate_m_s_, along));
    const double left_m_s = max_m_s - std::hypot(kSway_rad_s * behind_m, comes_m_s);
    left_m_s_ = std::max({0.0, left_m_s, std::min(before_m_s_, max_m_s) - kFall_m_s2 * interval_s_});
    return left_m_s_;
  }
  void forget() { *this = CatchUp(interval_s_); }

 private:
  // Measured: long poses sway once in 1.2 to 1.6 s; a little more, for the estimate comes late.
  static constexpr double kSway_rad_s = 4.5;
  static constexpr double kFreeShare = 0.12;
  static constexpr double kFall_m_s2 = 0.1;
  static constexpr double kStanding_s = 4.0;
  static constexpr double kRate_s = 0.03;
  static constexpr double kFree_m_s = 1.0;  // faster than any tip

  double interval_s_;
  bool has_begun_ = false;
  Vec3 standing_m_{}, lag_m_{}, rate_m_s_{};
  double left_m_s_ = kFree_m_s, before_m_s_ = kFree_m_s;
};

}  // namespace liana::arbiter
