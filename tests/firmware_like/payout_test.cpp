#include "firmware_like/cable/arm/payout.hpp"

#include <gtest/gtest.h>

#include <random>

namespace liana::cable {
namespace {

TEST(Payout, PayoutAndCountsAreInversesForBothDirections) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int32_t> counts_in_reach(-2000000, 2000000);
  for (const std::int32_t direction : {1, -1}) {
    const DriveParams drive{1.438e-6, direction, 1000000, 0.6};
    EXPECT_DOUBLE_EQ(payout_at_counts(drive, 1.3, 1000000), 1.3);
    EXPECT_GT(direction * (payout_at_counts(drive, 1.3, 1000001) - 1.3),
              0.0);  // +1: counts grow while cable is paid out
    for (int i = 0; i < 1000; ++i) {
      const std::int32_t counts = counts_in_reach(random);
      EXPECT_EQ(to_counts(counts_at_payout(drive, 1.3, payout_at_counts(drive, 1.3, counts))).value, counts);
    }
  }
}

}  // namespace
}  // namespace liana::cable
