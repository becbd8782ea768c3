// Virtual walls: told as plane, stiffness and damping, rendered at 1 kHz.
#include "host/control/virtual_fixtures/moving_plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/operator/haptics/haptic_loop.hpp"
#include "host/operator/haptics/omega.hpp"

namespace liana::haptics {
namespace {

constexpr Plane kWall{{0.0, -1.0, 0.0}, -0.01, 1500.0, 10.0};  // free below y = 10 mm

TEST(Fixture, PushesOnlyFromInsideAndNeverPulls) {
  struct Row {
    double y_m, speed_m_s, expected_N;
  };
  for (const Row& row : {Row{0.0, 1.0, 0.0}, Row{0.01, 1.0, 0.0}, Row{0.012, 0.0, -3.0}, Row{0.012, 0.1, -4.0},
                         Row{0.012, -0.1, -2.0}, Row{0.012, -1.0, 0.0}}) {
    const Vec3 force = plane_force(kWall, 0.0, {{0.3, row.y_m, 0.0}, {0.0, row.speed_m_s, 0.0}});
    EXPECT_NEAR(force[1], row.expected_N, 1e-12) << row.y_m << " m, " << row.speed_m_s << " m/s";
    EXPECT_EQ(force[0], 0.0);
  }
}

TEST(Fixture, DampsTheSpeedAgainstAWallThatMovesItself) {
  EXPECT_NEAR(plane_force(kWall, 0.1, {{0.0, 0.012, 0.0}, {}})[1], -4.0, 1e-12);
}

TEST(Fixture, PlanesOutOfRangeAreRefusedAndChangeNothing) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  MovingPlane plane;
  ASSERT_TRUE(plane.take(kWall));
  for (int i = 0; i < 20; ++i) plane.advance();
  for (const Plane& wrong : {Plane{{0.0, -2.0, 0.0}, 0.0, 1.0, 1.0}, Plane{{0.0, kNan, 0.0}, 0.0, 1.0, 1.0},
                             Plane{{0.0, 1.0, 0.0}, kNan, 1.0, 1.0}, Plane{{0.0, 1.0, 0.0}, 0.0, 3001.0, 1.0},
                             Plane{{0.0, 1.0, 0.0}, 0.0, -1.0, 1.0}, Plane{{0.0, 1.0, 0.0}, 0.0, 1.0, 31.0},
                             Plane{{0.0, 1.0, 0.0}, 0.0, kNan, 1.0}, Plane{{0.0, 1.0, 0.0}, 0.0, 1.0, kNan}})
    EXPECT_FALSE(plane.take(wrong));
  plane.advance();
  EXPECT_EQ(plane.now().offset_m, kWall.offset_m);
  EXPECT_EQ(plane.now().stiffness_N_m, kWall.stiffness_N_m);
}

TEST(Fixture, AMovingWallIsFeltAsOneThatMovesEvenly) {
  MovingPlane plane;
  double last_N = 0.0, largest_N = 0.0;
  for (int ms = 0; ms < 400; ++ms) {
    if (ms % 20 == 0) plane.take({{0.0, -1.0, 0.0}, -0.01 + 30e-6 * ms, 1500.0, 10.0});  // 30 mm/s
    plane.advance();
    const double force_N = plane.force({{0.0, 0.011, 0.0}, {}})[1];
    if (ms > 60) largest_N = std::max(largest_N, std::fabs(force_N - last_N));
    last_N = force_N;
  }
  EXPECT_LT(largest_N, 0.06);  // K times 30 um, with rounding; held for 20 ms it would be 0.9 N
}

// Nothing but the wall: no damping in free air, no tank that would take a chattering wall away.
HandLoopTable bare() {
  HandLoopTable table;
  table.damping_N_s_m = 0.0;
  table.tank.start_J = table.tank.most_J = std::numeric_limits<double>::infinity();
  return table;
}

struct Ripple {
  double force_N = 0.0;     // RMS around the mean
  double position_m = 0.0;  // peak to peak
};

// A hand that presses with a force against the wall for 4 s; the last second is judged.
Ripple press(double press_N, const Plane& wall, const HandParams& hand) {
  HapticLoop loop(bare());
  HeldOmega omega({}, hand, {}, 1);
  const double aim_m = 0.01 + press_N / hand.stiffness_N_m + press_N / wall.stiffness_N_m;
  double sum = 0.0, square = 0.0, least_m = 1.0, most_m = -1.0;
  for (int ms = 0; ms < 4000; ++ms) {
    if (ms % 20 == 0) loop.take(wall);
    const auto sample = omega.sample();
    const double force_N = loop.step(sample, sample.pose.position_m).force_N[1];
    omega.step({0.0, force_N, 0.0}, {{0.0, aim_m * std::min(1.0, ms / 1000.0), 0.0}, {}, true});
    if (ms < 3000) continue;
    sum += force_N / 1000.0;
    square += force_N * force_N / 1000.0;
    least_m = std::min(least_m, omega.truth().position_m[1]);
    most_m = std::max(most_m, omega.truth().position_m[1]);
  }
  EXPECT_NEAR(-sum, press_N, 0.1);
  return {std::sqrt(std::max(0.0, square - sum * sum)), most_m - least_m};
}

// The bounds of the study that chose K 1500 and B 10: 0.2 N RMS, 0.3 mm.
TEST(Fixture, AWallOf1500NewtonsAMetreDoesNotChatterUnderAnyHandThatPresses) {
  for (const double press_N : {1.0, 4.0, 8.0}) {
    for (const double mass_kg : {0.05, 0.3, 2.0}) {
      HandParams hand;
      hand.mass_kg = mass_kg;
      hand.stiffness_N_m = 200.0;
      hand.min_damping_N_s_m = 0.5;
      hand.tremor_m = 0.0;
      const Ripple ripple = press(press_N, kWall, hand);
      EXPECT_LT(ripple.force_N, 0.02) << press_N << " N, " << mass_kg << " kg";
      EXPECT_LT(ripple.position_m, 3e-5) << press_N << " N, " << mass_kg << " kg";
    }
  }
}

TEST(Fixture, TheCheckForChatterFindsAWallThatIsTooStiffForItsDamping) {
  HandParams hand;
  hand.mass_kg = 0.05;
  hand.stiffness_N_m = 200.0;
  hand.min_damping_N_s_m = hand.damping_ratio = 0.0;
  hand.tremor_m = 0.0;
  HapticLoop loop(bare());
  HeldOmega omega({}, hand, {}, 1);
  double least_m = 1.0, most_m = -1.0;
  for (int ms = 0; ms < 4000; ++ms) {
    if (ms % 20 == 0) loop.take(Plane{{0.0, -1.0, 0.0}, -0.01, 3000.0, 0.0});
    const auto sample = omega.sample();
    omega.step(loop.step(sample, sample.pose.position_m).force_N,
               {{0.0, 0.04 * std::min(1.0, ms / 1000.0), 0.0}, {}, true});
    if (ms < 3000) continue;
    least_m = std::min(least_m, omega.truth().position_m[1]);
    most_m = std::max(most_m, omega.truth().position_m[1]);
  }
  EXPECT_GT(most_m - least_m, 3e-4);
}

}  // namespace
}  // namespace liana::haptics
