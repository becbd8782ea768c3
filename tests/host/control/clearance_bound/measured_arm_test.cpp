// The measured arm at an earlier moment.
#include "host/control/clearance_bound/measured_arm.hpp"

#include <gtest/gtest.h>

namespace liana::clearance_bound {
namespace {

constexpr double kTick_s = 0.004;

// The first angle is the tick in milliradians: 0.25 rad/s.
ArmHistory moving_evenly(std::uint64_t last_tick) {
  ArmHistory history(kTick_s);
  for (std::uint64_t tick = 0; tick <= last_tick; tick += 5) history.note(tick, {1e-3 * static_cast<double>(tick)});
  return history;
}

TEST(ArmHistory, IsExactAtItsEntriesAndStraightBetweenThem) {
  const ArmHistory history = moving_evenly(100);
  for (const std::uint64_t tick : {30u, 60u, 63u, 99u, 100u}) {
    const auto arm = history.at(tick);
    ASSERT_TRUE(arm) << tick;
    EXPECT_NEAR(arm->theta_rad[0], 1e-3 * static_cast<double>(tick), 1e-15) << tick;
    EXPECT_NEAR(arm->rate_rad_s[0], 0.25, 1e-12) << tick;
  }
}

TEST(ArmHistory, HasNothingBeforeItBeginsAfterItEndsAndBeyondItsLength) {
  EXPECT_FALSE(ArmHistory(kTick_s).at(0));
  const ArmHistory history = moving_evenly(1000);
  EXPECT_FALSE(history.at(1001));
  EXPECT_TRUE(history.at(1000 - 63 * 5));
  EXPECT_FALSE(history.at(1000 - 64 * 5));
}

TEST(ArmHistory, TheFirstEntryStands) {
  ArmHistory history(kTick_s);
  history.note(7, {0.3});
  EXPECT_EQ(history.at(7)->rate_rad_s, ThetaVector{});
}

}  // namespace
}  // namespace liana::clearance_bound
