#include "host/control/timing/trajectory_timing.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace liana::motion {

namespace {

constexpr double kPeakSpeed = 1.875;         // of minimum jerk, per unit way and time
constexpr double kPeakAccel = 5.7735026919;  // 10 / sqrt(3)
constexpr double kPeakJerk = 60.0;

}  // namespace

FilterBounds share_of(const FilterBounds& bounds) {
  return {kMoveShare * bounds.speed, kMoveShare * bounds.accel, kMoveShare * bounds.jerk};
}

void MoveNeeds::add(double way, const FilterBounds& bounds) {
  speed_s = std::max(speed_s, way / bounds.speed);
  accel_s2 = std::max(accel_s2, way / bounds.accel);
  jerk_s3 = std::max(jerk_s3, way / bounds.jerk);
}

namespace {

double minimum_jerk(double share) {
  const double s = std::max(share, 0.0);
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

double minimum_jerk_s(const MoveNeeds& needs) {
  return std::max(
      {kPeakSpeed * needs.speed_s, std::sqrt(kPeakAccel * needs.accel_s2), std::cbrt(kPeakJerk * needs.jerk_s3)});
}

constexpr double kFewOff = 0.1;  // what two averages allow a period to be off

// Averages about the slow period, as shares of it, the longest two last.
constexpr std::array kFew{0.94, 1.06};
constexpr std::array kMany{0.85, 1.0, 1.18};

// One average more, where those about the slow period do not keep the limits: the fastest is one over the longest, the
// hardest acceleration one over the two longest. Two that are nearly equal meet in the middle: twice the jerk.
double further_average_s(const MoveNeeds& needs, double shorter_s, double longer_s) {
  double out_s = 2.0 * needs.jerk_s3 / (shorter_s * longer_s);
  if (needs.accel_s2 > shorter_s * longer_s) out_s = std::max(out_s, needs.accel_s2 / longer_s);
  if (needs.speed_s > longer_s) out_s = std::max(out_s, needs.speed_s);
  return out_s;
}

}  // namespace

TrajectoryTiming::TrajectoryTiming(const MoveNeeds& needs, const Swings& swings) {
  if (needs.speed_s <= 0.0) return;  // no way to go
  if (swings.slow_s <= 0.0) {
    duration_s_ = minimum_jerk_s(needs);
    return;
  }
  const std::span<const double> shares = swings.off > kFewOff ? std::span<const double>(kMany) : kFew;
  const double shorter_s = shares[shares.size() - 2] * swings.slow_s, longer_s = shares.back() * swings.slow_s;
  for (const double share : shares) add_average(share * swings.slow_s);
  add_average(swings.quick_s);
  add_average(further_average_s(needs, shorter_s, longer_s));
}

void TrajectoryTiming::add_average(double length_s) {
  if (length_s <= 0.0) return;
  average_s_[averages_++] = length_s;
  duration_s_ += length_s;
}

// n averages of a pulse, integrated, are polynomials of order n that set in at the sums of their lengths.
double TrajectoryTiming::share_at(double time_s) const {
  if (time_s >= duration_s_) return 1.0;
  if (averages_ == 0) return minimum_jerk(time_s / duration_s_);
  double sum = 0.0;
  for (unsigned subset = 0; subset < 1U << averages_; ++subset) {
    double since_s = time_s, sign = 1.0;
    for (std::size_t i = 0; i < averages_; ++i) {
      if ((subset >> i & 1U) == 0) continue;
      since_s -= average_s_[i];
      sign = -sign;
    }
    if (since_s <= 0.0) continue;
    double term = sign;
    for (std::size_t i = 0; i < averages_; ++i) term *= since_s / (average_s_[i] * static_cast<double>(i + 1));
    sum += term;
  }
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace liana::motion
