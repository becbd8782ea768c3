// Time laws keep the limits they are made for, and leave nothing of the swings they are made against.
#include "host/control/timing/trajectory_timing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace liana::motion {
namespace {

constexpr double kTurn_rad = 2.0 * 3.14159265358979323846;
constexpr double kStep_s = 0.01;

// The largest of speed, acceleration and jerk on a way of 1, by differences.
struct Most {
  double speed = 0.0;
  double accel = 0.0;
  double jerk = 0.0;
};

Most max_of(const TrajectoryTiming& law) {
  const double h = law.duration_s() / 2000.0;
  const auto at = [&](int i) { return law.share_at(h * i); };
  Most most;
  for (int i = -3; i <= 2003; ++i) {
    most.speed = std::max(most.speed, std::fabs(at(i + 1) - at(i)) / h);
    most.accel = std::max(most.accel, std::fabs(at(i + 1) - 2.0 * at(i) + at(i - 1)) / (h * h));
    most.jerk = std::max(most.jerk, std::fabs(at(i + 2) - 3.0 * at(i + 1) + 3.0 * at(i) - at(i - 1)) / (h * h * h));
  }
  return most;
}

// What is left of a swing without damping that the motion has pushed: its amplitude per way.
double left_swinging(const TrajectoryTiming& law, double period_s) {
  const double rate_rad_s = kTurn_rad / period_s;
  double cosines = 0.0, sines = 0.0;
  for (double t = 0.0; t < law.duration_s(); t += kStep_s) {
    const double accel = law.share_at(t + kStep_s) - 2.0 * law.share_at(t) + law.share_at(std::max(t - kStep_s, 0.0));
    cosines += accel / kStep_s * std::cos(rate_rad_s * t);
    sines += accel / kStep_s * std::sin(rate_rad_s * t);
  }
  return std::hypot(cosines, sines) / rate_rad_s;
}

MoveNeeds needs_of(double way, const FilterBounds& bounds) {
  MoveNeeds out;
  out.add(way, bounds);
  return out;
}

TEST(TrajectoryTiming, WithoutSwingsIsTheShortestMinimumJerkMotionWithinTheLimits) {
  EXPECT_NEAR(TrajectoryTiming(needs_of(0.4, {0.05, 10.0, 10.0}), {}).duration_s(), 1.875 * 0.4 / 0.05, 1e-12);
  EXPECT_NEAR(TrajectoryTiming(needs_of(0.4, {10.0, 0.02, 10.0}), {}).duration_s(),
              std::sqrt(10.0 / std::sqrt(3.0) * 20.0), 1e-8);
  EXPECT_NEAR(TrajectoryTiming(needs_of(0.4, {10.0, 10.0, 0.01}), {}).duration_s(), std::cbrt(60.0 * 40.0), 1e-12);
}

TEST(TrajectoryTiming, WithoutAWayIsOverAtOnce) {
  const TrajectoryTiming law(needs_of(0.0, {1.0, 1.0, 1.0}), {25.0, 8.0});
  EXPECT_EQ(law.duration_s(), 0.0);
  EXPECT_EQ(law.share_at(0.0), 1.0);
}

TEST(TrajectoryTiming, GoesFromEndToEndWithoutTurningBackAndKeepsEveryLimit) {
  std::mt19937_64 engine(52001);
  const auto in = [&](double low, double high) {
    return low * std::pow(high / low, static_cast<double>(engine() >> 11) / 9007199254740992.0);
  };
  for (int i = 0; i < 300; ++i) {
    const FilterBounds bounds{in(0.005, 0.2), in(0.001, 0.2), in(0.001, 0.5)};
    const double way = in(0.001, 5.0);
    const Swings swings{i % 3 == 0 ? 0.0 : in(5.0, 40.0), i % 3 == 1 ? 0.0 : in(1.0, 5.0)};
    const TrajectoryTiming law(needs_of(way, bounds), {swings.slow_s, swings.quick_s, i % 2 == 0 ? 0.1 : 0.2});
    EXPECT_EQ(law.share_at(-1.0), 0.0);
    EXPECT_EQ(law.share_at(law.duration_s()), 1.0);
    EXPECT_NEAR(law.share_at(0.5 * law.duration_s()), 0.5, 1e-9);
    for (int k = 0; k < 200; ++k)
      EXPECT_GE(law.share_at(law.duration_s() * (k + 1) / 200.0), law.share_at(law.duration_s() * k / 200.0) - 1e-9);
    const Most most = max_of(law);
    EXPECT_LE(way * most.speed, bounds.speed * 1.001) << i;
    EXPECT_LE(way * most.accel, bounds.accel * 1.001) << i;
    EXPECT_LE(way * most.jerk, bounds.jerk * 1.02) << i;  // by differences of third order
  }
}

// req:B16
// req:B16
TEST(TrajectoryTiming, LeavesLittleOfItsWayToASwingWhosePeriodIsAFifthOffWhenItIsToldThatItMayBe) {
  const FilterBounds arm{0.09, 0.09, 0.36};
  for (const double way : {0.05, 0.5, 4.0}) {
    const TrajectoryTiming law(needs_of(way, arm), {36.0, 9.0, 0.2});
    for (const double off : {0.8, 0.85, 0.9, 1.0, 1.1, 1.2}) {
      EXPECT_LT(left_swinging(law, off * 36.0), 0.008) << way << " m, " << off;
      EXPECT_LT(left_swinging(law, off * 9.0), 0.005) << way << " m, " << off;
    }
  }
  EXPECT_GT(left_swinging(TrajectoryTiming(needs_of(0.5, arm), {36.0, 9.0}), 1.2 * 36.0), 0.03)
      << "which two averages do not";
}

// req:B16
TEST(TrajectoryTiming, LeavesLessThanAHundredthOfItsWayToABaseThatSwingsThoughPeriodsAreATenthOff) {
  const FilterBounds arm{0.09, 0.09, 0.36};
  for (const double way : {0.05, 0.5, 4.0}) {
    const TrajectoryTiming law(needs_of(way, arm), {26.7, 5.6});
    for (const double off : {0.9, 0.94, 1.0, 1.06, 1.1}) {
      EXPECT_LT(left_swinging(law, off * 26.7), 0.008) << way << " m, " << off;
      EXPECT_LT(left_swinging(law, off * 5.6), 0.005) << way << " m, " << off;
    }
  }
  EXPECT_GT(left_swinging(TrajectoryTiming(needs_of(0.5, arm), {}), 26.7), 0.1) << "which minimum jerk does not";
}

}  // namespace
}  // namespace liana::motion
