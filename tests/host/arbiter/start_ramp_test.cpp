// An arm that has stood in the slit gets going slowly, and is asked for less there than the limit.
#include "host/arbiter/start_ramp.hpp"

#include <gtest/gtest.h>

#include "host/arbiter/speed_zone.hpp"
#include "tests/host/arbiter/interval.hpp"

namespace liana::arbiter {
namespace {

TEST(StartRamp, AsksForLittleWhileTheCommandStands) {
  StartRamp ramp;
  for (int k = 0; k < 100; ++k) ramp.note({2.0, 0.0, 0.0}, kInterval_s);
  EXPECT_LT(ramp.speed_m_s(), 0.006);
}

TEST(StartRamp, AHandThatTremblesIsNoStart) {
  StartRamp ramp;
  for (int k = 0; k < 100; ++k) ramp.note({2.0 + (k % 2 == 0 ? 2e-5 : 0.0), 0.0, 0.0}, kInterval_s);
  EXPECT_LT(ramp.speed_m_s(), 0.006);
}

TEST(StartRamp, RisesWhileTheCommandMovesAndBeginsAnewWhenItHasStood) {
  StartRamp ramp;
  Vec3 tip_m{2.0, 0.0, 0.0};
  ramp.note(tip_m, kInterval_s);
  double time_s = 0.0;
  while (ramp.speed_m_s() < 0.026) {
    tip_m[0] += ramp.speed_m_s() * kInterval_s;
    ramp.note(tip_m, kInterval_s);
    time_s += kInterval_s;
    ASSERT_LT(time_s, 4.0);
  }
  EXPECT_GT(time_s, 2.5);
  ramp.note(tip_m, kInterval_s);
  EXPECT_LT(ramp.speed_m_s(), 0.006);
}

// req:A9
TEST(SpeedZone, AsksForLessThanItAllowsBecauseTheTrueTipSwings) {
  config::SceneSlit slit;
  slit.normal = {0, 1, 0};
  slit.u_axis = {1, 0, 0};
  slit.mouth_u_m = 1.75;
  slit.end_u_m = 3.7;
  slit.half_gap_m = 0.05;
  const SpeedZone zone(slit, 0.03);
  EXPECT_DOUBLE_EQ(zone.limit_at({2.0, 0.0, 0.0}, 0.1), 0.03);
  EXPECT_DOUBLE_EQ(zone.advice_at({2.0, 0.0, 0.0}, 0.1), 0.0261);
  EXPECT_DOUBLE_EQ(zone.advice_at({2.0, 0.0, 0.0}, 0.01), 0.01);
  EXPECT_TRUE(zone.slows_at({1.70, 0.0, 0.0})) << "braking";
  EXPECT_FALSE(zone.slows_at({1.60, 0.0, 0.0}));
  EXPECT_DOUBLE_EQ(zone.advice_at({1.60, 0.0, 0.0}, 0.1), 0.1);
}

}  // namespace
}  // namespace liana::arbiter
