#include "host/arbiter/time_law.hpp"

#include <algorithm>
#include <cmath>

namespace liana::arbiter {

namespace {

constexpr double kPeakSpeed = 1.875;         // of minimum jerk, per unit way and time
constexpr double kPeakAccel = 5.7735026919;  // 10 / sqrt(3)
constexpr double kPeakJerk = 60.0;

}  // namespace

FilterBounds share_of(const FilterBounds& bounds) {
  return {kMoveShare * bounds.speed, kMoveShare * bounds.accel, kMoveShare * bounds.jerk};
}

double minimum_jerk(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

double time_for_speed(double way, double speed) { return kPeakSpeed * way / speed; }

double time_for_accel(double way, double accel) { return std::sqrt(kPeakAccel * way / accel); }

double time_within(double way, const FilterBounds& bounds) {
  return std::max(
      {time_for_speed(way, bounds.speed), time_for_accel(way, bounds.accel), std::cbrt(kPeakJerk * way / bounds.jerk)});
}

}  // namespace liana::arbiter
