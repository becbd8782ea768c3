// What the drives of a cable arm may be told: the table's limits in drive units.
#include "firmware_like/cable/arm/drive_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/cable/arm/payout.hpp"
#include "tests/firmware_like/safety_bench.hpp"

namespace liana::cable {
namespace {

using namespace safety_bench;

TEST(DriveLimits, TheGatesRangeIsWhatBendingAndElongationCanAddOrTake) {
  const GateLimits limits = make_gate_limits(table(), zero_payout_m());
  EXPECT_EQ(limits.drive_count, kDrives);
  const double arm_m = std::sqrt(0.025 * 0.025 + 0.010 * 0.010);
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    const double bend_m = arm_m * 2.0 * 0.35 * (i < 3 ? 8.0 : 16.0);
    const double elongation_m = (1.3 + bend_m) * 600.0 / 240000.0;
    const double range_counts = (bend_m + elongation_m) / kMetresPerCount;
    EXPECT_NEAR(limits.drive[i].min_counts, 1000000.0 - range_counts, 1e-6) << "direction " << (i % 2 == 0 ? 1 : -1);
    EXPECT_NEAR(limits.drive[i].max_counts, 1000000.0 + range_counts, 1e-6);
    EXPECT_EQ(limits.drive[i].step_counts, 51);  // 10 mm/s * 4 ms * 1.25 = 50 counts of 1 um, and one of rounding
    EXPECT_EQ(limits.drive[i].let_go_counts, i % 2 == 0 ? 8001 : -8001) << "8 mm, the way that pays out";
    EXPECT_EQ(limits.drive[i].mode, DriveMode::kCyclicPosition);
  }
}

TEST(DriveLimits, ACableMayPullUpToTheCeilingOfFreeMotionAndNeverPush) {
  const GateLimits limits = make_gate_limits(table(), zero_payout_m());
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    EXPECT_EQ(limits.drive[i].min_permille, 0.0);
    EXPECT_EQ(limits.drive[i].max_permille, 150.0 / 0.6);
  }
}

}  // namespace
}  // namespace liana::cable
