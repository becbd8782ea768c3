// A dither of the tensions: grows and ends without a jump, within the limits of tension.
#include "firmware_like/cable/arm/dither.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

constexpr double kTick_s = 0.004;

TEST(Dither, GrowsAndEndsWithoutAJumpHoweverItIsAskedFor) {
  DitherState state;
  double before = 0.0, most = 0.0;
  for (int tick = 0; tick < 1600; ++tick) {
    const double wanted = tick < 1000 ? kDitherMost : (tick < 1500 ? 0.1 : 0.0);
    const double now = advance_dither(wanted, kTick_s, state);
    // The slope of the oscillation, and what the share may change by.
    EXPECT_LE(std::fabs(now - before), kTick_s * (6.3 * kDither_hz * kDitherMost + kDitherSlew_1_s)) << tick;
    most = std::fmax(most, std::fabs(now));
    before = now;
  }
  EXPECT_NEAR(most, kDitherMost, 0.01);
  EXPECT_EQ(before, 0.0);
  EXPECT_TRUE(is_dithering(state)) << "torques follow for a while";
  for (int tick = 0; tick < 500; ++tick) advance_dither(0.0, kTick_s, state);
  EXPECT_FALSE(is_dithering(state));
}

TEST(Dither, FitsWhereEveryTensionStaysBetweenFloorAndCeiling) {
  const RobotParams table = zhu2022::table();
  CableVector planned_N{};
  planned_N.fill(60.0);
  EXPECT_TRUE(dither_fits(table, planned_N, 0.3));
  planned_N[3] = 21.0;
  EXPECT_FALSE(dither_fits(table, planned_N, 0.3)) << "14.7 N is under the floor";
  EXPECT_TRUE(dither_fits(table, planned_N, 0.25));
  planned_N[3] = 116.0;
  EXPECT_FALSE(dither_fits(table, planned_N, 0.3)) << "150.8 N is over the ceiling";
}

}  // namespace
}  // namespace liana::cable
