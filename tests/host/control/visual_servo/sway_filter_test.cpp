#include "host/control/visual_servo/sway_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace liana::visual_servo {
namespace {

constexpr double kTurn_rad = 2.0 * 3.14159265358979323846;
const Vec3 kPlace_m{4.0, 0.5, 1.0};

// A base that swings slowly along y and quicker along x.
Vec3 swung_m(double time_s, double slow_s, double quick_s) {
  return add(kPlace_m,
             {0.003 * std::sin(kTurn_rad * time_s / quick_s), 0.01 * std::cos(kTurn_rad * time_s / slow_s), 0.0});
}

// Ten images a second, with the camera's noise.
SwayFilter after(double until_s, double slow_s, double quick_s, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto noise_m = [&] {
    double sum = -6.0;  // twelve of them have a deviation of 1
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine() >> 11) / 9007199254740992.0;
    return 0.002 * sum;
  };
  SwayFilter filter({25.0, 8.0});
  for (int i = 0; 0.1 * i < until_s; ++i) {
    const Vec3 seen_m = add(swung_m(0.1 * i, slow_s, quick_s), {noise_m(), noise_m(), noise_m()});
    if (i == 0) filter.begin(0.0, seen_m);
    if (i > 0) filter.see(0.1 * i, seen_m);
  }
  return filter;
}

// req:B16
TEST(SwayFilter, FindsTheMiddleOfTwoSwingsWithinAMillimetreThoughPeriodsAreATenthOff) {
  for (std::uint64_t seed = 81001; seed < 81101; ++seed) {
    const double off = 0.9 + 0.002 * static_cast<double>(seed - 81001);
    const SwayFilter filter = after(60.0, 25.0 * off, 8.0 * off, seed);
    EXPECT_LT(norm(subtract(filter.mean(), kPlace_m)), 0.003) << seed;
    EXPECT_NEAR(filter.amplitude(), 0.013, 0.005) << seed;
  }
}

TEST(SwayFilter, DoesNotKnowTheMiddleFromAShortPieceOfASwing) {
  EXPECT_GT(after(2.0, 25.0, 8.0, 1).mean_deviation(), 0.002);
  EXPECT_LT(after(30.0, 25.0, 8.0, 1).mean_deviation(), 0.001);
}

TEST(SwayFilter, CalmsWithWhatTheSlowSwingWasAQuarterOfItsPeriodBefore) {
  const SwayFilter filter = after(50.0, 25.0, 8.0, 2);
  for (const double time_s : {50.0, 53.0, 57.0}) {
    const double before_m = 0.01 * std::cos(kTurn_rad * (time_s - 6.25) / 25.0);
    EXPECT_NEAR(filter.calming(time_s)[1], -before_m, 0.002) << time_s;
  }
}

// An arm of a fifth of the base's mass moves as the filter says, and is `late_s` late: the base comes to rest.
TEST(SwayFilter, CalmsABaseThatSwings) {
  constexpr double kStep_s = 0.01, kRate = kTurn_rad / 25.0, kShare = 0.2;
  SwayFilter filter({25.0, 0.0});
  double base_m = 0.01, speed = 0.0;
  Vec3 arm_m{}, arm_speed{};
  for (int i = 0; i < 20000; ++i) {
    const double time_s = kStep_s * i;
    const Vec3 seen_m{kPlace_m[0] - base_m, kPlace_m[1], kPlace_m[2]};
    if (i == 0) filter.begin(0.0, seen_m);
    if (i > 0 && i % 10 == 0) filter.see(time_s, seen_m);
    const Vec3 wished = scale(subtract(filter.calming(time_s), arm_m), 1.0);
    const Vec3 accel = scale(subtract(wished, arm_speed), 1.0);
    arm_speed = add(arm_speed, scale(accel, kStep_s));
    arm_m = add(arm_m, scale(arm_speed, kStep_s));
    speed += kStep_s * (-kRate * kRate * base_m - kShare * accel[0]);
    base_m += kStep_s * speed;
  }
  EXPECT_LT(std::hypot(base_m, speed / kRate), 0.003);
}

}  // namespace
}  // namespace liana::visual_servo
