// From hand to true tip: how late, at the speeds of the robot table, and what of it the cables feel (req:A16).
#include "hand_to_tip.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr double kMostLag_s = 0.40;
constexpr double kLeast_N = 15.0;

const Led kFree{};
const Led kInSlit{"segment5_in_slit", {1.0, 0.0, 0.0}, 0.03, 0x100};

void expect_in_time(const std::string& name, const Led& led, double speed_m_s) {
  ArmToLead arm(led, robot_table().limits, 1);
  arm.settle(led);
  const Following found = follow_steadily(arm, led, speed_m_s);
  measured(name + ": lag", 1000.0 * found.lag_s, "ms");
  measured(name + ": swing", found.swing_mm, "mm");
  measured(name + ": least tension", found.least_N, "N");
  EXPECT_LT(found.lag_s, kMostLag_s);
  EXPECT_GE(found.least_N, kLeast_N);
  EXPECT_EQ(found.faults, 0);
}

TEST(HandToTip, TakesAtMost400MillisecondsAtFullSpeedInFreeSpace) { expect_in_time("free, 0.1 m/s", kFree, 0.099); }

TEST(HandToTip, TakesAtMost400MillisecondsInTheSlit) { expect_in_time("slit, 0.03 m/s", kInSlit, 0.0297); }

TEST(HandToTip, AReachOf60MillimetresSwingsLittlePastItsEnd) {
  ArmToLead arm(kFree, robot_table().limits, 1);
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
