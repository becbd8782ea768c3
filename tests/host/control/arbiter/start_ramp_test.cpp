// An arm that has stood in the slit gets going slowly, and is asked for less there than the limit.
#include "host/control/arbiter/start_ramp.hpp"

#include <gtest/gtest.h>

#include "host/control/arbiter/speed_zone.hpp"
#include "tests/host/control/arbiter/interval.hpp"

namespace liana::arbiter {
namespace {

TEST(StartRamp, AsksForLittleWhileTheCommandStands) {
  StartRamp ramp;
  for (int k = 0; k < 100; ++k) ramp.note(0.0, kInterval_s);
  EXPECT_LT(ramp.speed_m_s(), 0.006);
}

TEST(StartRamp, AHandThatTremblesIsNoStart) {
  StartRamp ramp;
  for (int k = 0; k < 100; ++k) ramp.note(2e-5 / kInterval_s, kInterval_s);
  EXPECT_LT(ramp.speed_m_s(), 0.006);
}

TEST(StartRamp, RisesWhileTheCommandMovesAndBeginsAnewWhenItHasStood) {
  StartRamp ramp;
  ramp.note(0.0, kInterval_s);
  double time_s = 0.0;
  while (ramp.speed_m_s() < 0.026) {
    ramp.note(ramp.speed_m_s(), kInterval_s);
    time_s += kInterval_s;
    ASSERT_LT(time_s, 4.0);
  }
  EXPECT_GT(time_s, 2.5);
  ramp.note(0.0, kInterval_s);
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

// The tip follows what the ramp allows, at its own acceleration.
double time_to(GoalRamp& ramp, double speed_m_s) {
  constexpr double kAccel_m_s2 = 0.22;
  double time_s = 0.0, v_m_s = 0.0;
  while (v_m_s < speed_m_s && time_s < 10.0) {
    v_m_s = std::min(ramp.speed_m_s(), v_m_s + kAccel_m_s2 * kInterval_s);
    ramp.note(v_m_s, kInterval_s);
    time_s += kInterval_s;
  }
  return time_s;
}

GoalRamp at_rest() {
  GoalRamp ramp(0.1, 0.08);
  for (int k = 0; k < 20; ++k) ramp.note(0.0, kInterval_s);
  return ramp;
}

TEST(GoalRamp, LetsTheTipSpeedUpAsItIsSetAndNoFurtherThanItsMost) {
  GoalRamp ramp = at_rest();
  EXPECT_NEAR(time_to(ramp, 0.08), 0.6, 0.05) << "it begins a fifth of a second ahead";
  EXPECT_DOUBLE_EQ(ramp.speed_m_s(), 0.08);
}

TEST(GoalRamp, BeginsAnewWhereTheTipHasSlowedDown) {
  GoalRamp ramp = at_rest();
  time_to(ramp, 0.08);
  ramp.note(0.0, kInterval_s);
  EXPECT_NEAR(ramp.speed_m_s(), 0.02, 1e-9) << "a fifth of a second of its acceleration";
}

}  // namespace
}  // namespace liana::arbiter
