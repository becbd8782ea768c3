// A plane that comes and goes under a hand, without a step.
#include "host/control/virtual_fixtures/guide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "tests/host/control/virtual_fixtures/interval.hpp"

namespace liana::virtual_fixtures {
namespace {

GuidePlane level(double y_m) { return {{{0.0, y_m, 0.0}}, {1.0, 0.0, 0.0, 0.0}, -kPi, kPi}; }

double turn_between(const Pose& a, const Pose& b) {
  return norm(rotation_vector(multiply(a.quaternion, conjugate(b.quaternion))));
}

TEST(Guide, WithoutAPlaneEveryGoalIsItself) {
  Guide guide;
  const Pose goal{{1.0, 2.0, 3.0}, quaternion_of({0.1, 0.2, 0.3})};
  const Pose led = guide.next(goal, std::nullopt, kInterval_s);
  EXPECT_EQ(led.position_m, goal.position_m);
  EXPECT_NEAR(turn_between(led, goal), 0.0, 1e-15);
}

TEST(Guide, BleedsWhatAPlaneTakesAwayInsteadOfTakingItAtOnce) {
  Guide guide;
  const Pose goal{{0.0, 0.010, 0.0}, quaternion_of({0.05, 0.0, 0.0})};
  Pose before = goal;
  double seconds = 0.0;
  for (double speed_m_s = 0.0; before.position_m[1] > 1e-9 && seconds < 20.0; seconds += kInterval_s) {
    const Pose led = guide.next(goal, level(0.0), kInterval_s);
    EXPECT_LE(std::fabs(led.position_m[1] - before.position_m[1]), kBleed_m.most * kInterval_s + 1e-12);
    const double now_m_s = (before.position_m[1] - led.position_m[1]) / kInterval_s;
    EXPECT_LE(std::fabs(now_m_s - speed_m_s), 1e-4 + 1e-9) << "gently at both ends, " << seconds << " s";
    speed_m_s = now_m_s;
    EXPECT_LE(turn_between(led, before), kBleed_rad.most * kInterval_s + 1e-9);
    before = led;
  }
  EXPECT_LT(seconds, 12.0);
}

TEST(Guide, OnceInThePlaneAHandThatPushesOutOfItDoesNothing) {
  Guide guide;
  guide.next({}, level(0.0), kInterval_s);
  for (int i = 1; i < 200; ++i) {
    const Pose led = guide.next({{0.0, 0.01 * i, 0.0}, quaternion_of({0.01 * i, 0.0, 0.0})}, level(0.0), kInterval_s);
    ASSERT_NEAR(led.position_m[1], 0.0, 1e-12) << "however fast it pushes";
    ASSERT_NEAR(turn_between(led, {}), 0.0, 1e-9);
  }
}

// A hand at up to 0.1 m/s, a plane that comes and goes at random, and is looked for anew after every release.
TEST(Guide, NeverStepsByMoreThanHandAndBleedWhateverComesAndGoes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  Guide guide;
  Pose goal;
  bool guided = false;
  std::optional<Pose> before;
  int switches = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 way{0.002 * one(random), 0.002 * one(random), 0.002 * one(random)};
    const Vec3 turn{0.003 * one(random), 0.003 * one(random), 0.003 * one(random)};
    goal = {add(goal.position_m, way), normalize(multiply(quaternion_of(turn), goal.quaternion))};
    if (one(random) > 0.96) guided = !guided, ++switches;
    if (one(random) > 0.98) {
      guide.stop();
      goal = before.value_or(goal);  // a hand that grips anew begins where the tip is
    }
    const Pose led = guide.next(goal, guided ? std::optional(level(0.005)) : std::nullopt, kInterval_s);
    if (before) {
      ASSERT_LE(norm(subtract(led.position_m, before->position_m)), norm(way) + kBleed_m.most * kInterval_s + 1e-12)
          << i;
      ASSERT_LE(turn_between(led, *before), 3.0 * norm(turn) + 2.0 * kBleed_rad.most * kInterval_s + 1e-9) << i;
    }
    before = led;
  }
  EXPECT_GT(switches, 300);
}

}  // namespace
}  // namespace liana::virtual_fixtures
