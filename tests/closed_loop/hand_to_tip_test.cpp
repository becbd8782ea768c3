// From hand to true tip: how late, at the speeds of the robot table, and what of it the cables feel (req:A16).
#include "hand_to_tip.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr double kMaxLag_s = 0.40;
constexpr double kLeast_N = 15.0;

// Out of it: farther in, the shape would have to be led past the wall as well.
Led in_slit() { return {"segment5_in_slit", scale(scene().slit->u_axis, -1.0), 0.03, 0x100}; }

Following led_steadily(const PlantSetup& setup, const Led& led, double speed_m_s) {
  ArmToLead arm(setup, robot_table().limits);
  arm.settle(led);
  return follow_steadily(arm, led, speed_m_s);
}

void expect_in_time(const std::string& name, const Led& led, double speed_m_s) {
  const Following exact = led_steadily(exact_arm(led), led, speed_m_s);
  const Following real = led_steadily(real_arm(led, 1), led, speed_m_s);
  measured(name + ": lag", 1000.0 * exact.lag_s, "ms");
  measured(name + ": swing without friction", exact.swing_mm, "mm");
  measured(name + ": swing, friction and spread", real.swing_mm, "mm");
  measured(name + ": least tension", real.least_N, "N");
  EXPECT_LT(exact.lag_s, kMaxLag_s);
  EXPECT_GE(real.least_N, kLeast_N);
  EXPECT_EQ(exact.faults + real.faults, 0);
}

TEST(HandToTip, TakesAtMost400MillisecondsAtFullSpeedInFreeSpace) { expect_in_time("free, 0.1 m/s", kFree, 0.099); }

TEST(HandToTip, TakesAtMost400MillisecondsInTheSlit) { expect_in_time("slit, 0.03 m/s", in_slit(), 0.0297); }

TEST(HandToTip, AReachOf60MillimetresSwingsLittlePastItsEnd) {
  ArmToLead arm(real_arm(kFree, 1), robot_table().limits);
  arm.settle(kFree);
  const Following found = follow_reach(arm, kFree, 0.06, 2.0);
  measured("reach of 60 mm in 2 s: past its end", found.overshoot_mm, "mm");
  measured("reach of 60 mm in 2 s: swing", found.swing_mm, "mm");
  measured("reach of 60 mm in 2 s: least tension", found.least_N, "N");
  EXPECT_LT(found.overshoot_mm, 12.0);
  EXPECT_GE(found.least_N, kLeast_N);
  EXPECT_EQ(found.faults, 0);
}

}  // namespace
}  // namespace liana::closed_loop
