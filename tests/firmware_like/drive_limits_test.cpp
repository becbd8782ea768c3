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

// Segments and drives of which no two are alike.
TEST(DriveLimits, EveryDriveHasTheLimitsOfItsOwnSegmentDriveAndCable) {
  RobotParams robot = table();
  robot.segment[1].modules = 5;
  robot.segment[1].theta_limit_rad = 0.20;
  robot.segment[1].hole_radius_m = 0.015;
  robot.segment[1].face_offset_m = 0.020;
  CableVector payout_m{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    const auto place = static_cast<double>(i);
    robot.drive[i].metres_per_count = 1e-6 * (1.0 + place);
    robot.drive[i].newtons_per_permille = 0.5 + 0.1 * place;
    payout_m[i] = 1.0 + 0.1 * place;
  }
  const GateLimits gate = make_gate_limits(robot, payout_m);
  const LinkLimits link = make_link_limits(robot);
  const double bend_m[] = {2.0 * std::hypot(0.025, 0.010) * 8 * 0.35,
                           2.0 * std::hypot(0.015, 0.020) * (8 * 0.35 + 5 * 0.20)};
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    const DriveParams& drive = robot.drive[i];
    const double bend = bend_m[i / 3], range_m = bend + (payout_m[i] + bend) * 600.0 / 240000.0;
    EXPECT_NEAR(gate.drive[i].min_counts, 1000000.0 - range_m / drive.metres_per_count, 1e-6) << i;
    EXPECT_NEAR(gate.drive[i].max_counts, 1000000.0 + range_m / drive.metres_per_count, 1e-6) << i;
    EXPECT_EQ(gate.drive[i].step_counts, std::lround(50e-6 / drive.metres_per_count) + 1) << i;
    EXPECT_EQ(gate.drive[i].max_permille, 150.0 / drive.newtons_per_permille) << i;
    EXPECT_EQ(link.following_counts[i], std::lround(775e-6 / drive.metres_per_count)) << i;
  }
}

}  // namespace
}  // namespace liana::cable
