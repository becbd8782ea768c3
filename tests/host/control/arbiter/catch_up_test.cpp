// An arm that lags is led more slowly, by as much as it has yet to sway after its command.
#include "host/control/arbiter/catch_up.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/control/arbiter/interval.hpp"

namespace liana::arbiter {
namespace {

constexpr double kLimit_m_s = 0.1, kMost_m_s = (1.0 - 0.12) * kLimit_m_s;
constexpr Vec3 kAlongX{0.05, 0.0, 0.0};

// A tip that is commanded along x with `speed_m_s` from the first note on, and one that comes after it.
struct Led {
  CatchUp catch_up{kInterval_s};
  double command_m = 0.0, tip_m = 0.0;

  double lead(double speed_m_s, double tip_m_s, double y_m = 0.0) {
    catch_up.note({command_m, y_m, 0.0}, {tip_m, 0.0, 0.0});
    command_m += speed_m_s * kInterval_s;
    tip_m += tip_m_s * kInterval_s;
    return catch_up.speed_m_s(kAlongX, kLimit_m_s);
  }
};

// req:A9
TEST(CatchUp, AnArmThatComesAlongHasAllButAFewPerCentOfItsLimit) {
  Led led;
  for (int k = 0; k < 200; ++k) EXPECT_NEAR(led.lead(0.08, 0.08), kMost_m_s, 1e-12);
}

// req:A9
TEST(CatchUp, AnArmThatFrictionHoldsIsLedMoreSlowly) {
  Led led;
  double before_m_s = kMost_m_s;
  for (int k = 0; k < 10; ++k) {  // to 16 mm
    const double left_m_s = led.lead(0.08, 0.0);
    EXPECT_LE(left_m_s, before_m_s);
    EXPECT_GE(left_m_s, before_m_s - 0.1 * kInterval_s - 1e-12) << "a command that brakes hard sways the arm, too";
    before_m_s = left_m_s;
  }
  for (int k = 0; k < 20; ++k) before_m_s = led.lead(0.0, 0.0);
  EXPECT_LT(before_m_s, 0.05);
  EXPECT_GT(before_m_s, 0.02);
}

// req:A9
TEST(CatchUp, AnArmThatSwaysOnIsLedMoreSlowlyWhereItHasNoLagLeft) {
  Led led;
  for (int k = 0; k < 8; ++k) led.lead(0.06, 0.02);
  for (int k = 0; k < 8; ++k) led.lead(0.06, 0.1);  // it is where the command is, and 40 mm/s faster
  EXPECT_LT(led.lead(0.06, 0.1), 0.07);
}

// req:A9
TEST(CatchUp, WhatStandsBesideTheCommandForGoodIsNoSwayToCome) {
  Led led;
  led.tip_m = -0.008;
  EXPECT_NEAR(led.lead(0.0, 0.0), kMost_m_s, 1e-12) << "from the beginning";
  led.command_m += 0.008;
  for (int k = 0; k < 500; ++k) led.lead(0.05, 0.05);
  EXPECT_GT(led.lead(0.05, 0.05), 0.083) << "after ten seconds";
}

// req:A9
TEST(CatchUp, ALagToTheSideOrAheadDoesNotSlowTheWay) {
  Led beside, ahead;
  beside.lead(0.0, 0.0);
  EXPECT_NEAR(beside.lead(0.0, 0.0, 0.02), kMost_m_s, 1e-12);
  ahead.lead(0.0, 0.0);
  for (int k = 0; k < 10; ++k) ahead.lead(0.0, -0.02);
  ahead.catch_up.note({ahead.command_m, 0.0, 0.0}, {ahead.tip_m, 0.0, 0.0});
  EXPECT_GT(ahead.catch_up.speed_m_s({0.0, 0.03, 0.0}, kLimit_m_s), 0.0879);
}

// req:A9
TEST(CatchUp, AWayOfNoLengthIsNotSlowedAndAnArmThatWasDisabledBeginsAnew) {
  Led led;
  for (int k = 0; k < 20; ++k) led.lead(0.08, 0.0);
  EXPECT_EQ(led.catch_up.speed_m_s({}, kLimit_m_s), kMost_m_s);
  led.catch_up.forget();
  EXPECT_NEAR(led.lead(0.0, 0.0), kMost_m_s, 1e-12);
}

}  // namespace
}  // namespace liana::arbiter
