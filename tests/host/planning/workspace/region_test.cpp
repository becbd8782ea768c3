#include "host/planning/workspace/region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana::workspace {
namespace {

namespace zhu2022 = cable::zhu2022;
using zhu2022::Random;

// Between two seeds the boundary differs by at most 0.05 m in a bin (full arm): twice that is allowed.
constexpr double kBoundary_m = 0.1;

RegionRequest request(std::int32_t node, std::uint32_t held_mask = 0, std::uint64_t seed = 1) {
  RegionRequest out;
  out.point = {.node = node, .held_mask = held_mask};
  out.samples = 20000;
  out.seed = seed;
  return out;
}

// The bin in the mirrored direction; `axis` 1 mirrors y (pitch), 2 mirrors z (yaw).
const DirectionBin& mirrored(const Region& region, const DirectionBin& bin, std::size_t axis) {
  Vec3 direction{std::cos(bin.polar_rad), std::sin(bin.polar_rad) * std::cos(bin.azimuth_rad),
                 std::sin(bin.polar_rad) * std::sin(bin.azimuth_rad)};
  direction[axis] = -direction[axis];
  return region.bins[direction_bin(direction)];
}

TEST(Bins, CoverTheSphereAndFindTheirOwnMiddle) {
  const Region region = explore_region(arm_of(zhu2022::table()), request(1));
  double solid_angle = 0.0;
  for (std::size_t i = 0; i < region.bins.size(); ++i) {
    const DirectionBin& bin = region.bins[i];
    const double half = bin.polar_width_rad / 2.0;
    solid_angle += bin.azimuth_width_rad * (std::cos(bin.polar_rad - half) - std::cos(bin.polar_rad + half));
    const double s = std::sin(bin.polar_rad);
    EXPECT_EQ(direction_bin({std::cos(bin.polar_rad), s * std::cos(bin.azimuth_rad), s * std::sin(bin.azimuth_rad)}),
              i);
  }
  EXPECT_NEAR(solid_angle, 4.0 * std::numbers::pi, 1e-9);
}

// req:A6
TEST(Region, OfTheStraightArmEndsAtItsLengthAlongX) {
  const Region region = explore_region(arm_of(zhu2022::table()), request(5));
  EXPECT_NEAR(region.extent_m[1][0], 4.0, 1e-12);
  EXPECT_NEAR(region.farthest_m, 4.0, 1e-12);
  EXPECT_NEAR(region.length_m, 4.0, 1e-12);
  EXPECT_EQ(region.dimension, 3);
  EXPECT_EQ(region.origin_in_base_m, (Vec3{0.0, 0.0, 0.0}));
}

TEST(Region, OfAnotherRobotEndsAtThatRobotsLength) {
  const Region region = explore_region(arm_of(zhu2022::uneven_table()), request(3));
  EXPECT_NEAR(region.farthest_m, 0.7 + 0.64 + 0.9, 1e-12);
}

TEST(Region, IsSymmetricUnderMirroredPitchAndMirroredYaw) {
  const Region region = explore_region(arm_of(zhu2022::table()), request(5));
  for (std::size_t axis : {1u, 2u}) {
    EXPECT_NEAR(region.extent_m[0][axis], -region.extent_m[1][axis], 2e-3);
    for (const DirectionBin& bin : region.bins) {
      EXPECT_NEAR(bin.outer.distance_m, mirrored(region, bin, axis).outer.distance_m, kBoundary_m)
          << bin.polar_rad << " " << bin.azimuth_rad;
    }
  }
}

TEST(Region, ContainsEveryPoseOfAnotherDraw) {
  const cable::RobotParams table = zhu2022::table();
  const ReachArm arm = arm_of(table);
  for (const std::int32_t node : {3, 5}) {
    const Region region = explore_region(arm, request(node));
    Random random(99);
    double beyond_m = -1e9;
    for (int trial = 0; trial < 20000; ++trial) {
      const AngleVector theta = random.theta(table, trial % 2 == 0 ? 20.0 : 6.0);
      const Vec3 point = forward_kinematics(table, theta).node_in_base[static_cast<std::size_t>(node)].position_m;
      beyond_m = std::max(beyond_m, norm(point) - region.bins[direction_bin(point)].outer.distance_m);
    }
    std::printf("measured: node %d: farthest pose beyond the boundary of its bin: %.4f m\n", node, beyond_m);
    EXPECT_LT(beyond_m, kBoundary_m);
  }
}

TEST(Region, OfAHollowReachHasAnInnerBoundaryThatNoPosePasses) {
  const cable::RobotParams table = zhu2022::table();
  const ReachArm arm = arm_of(table);
  const std::uint32_t last_segment_only = 0b0011111111;
  const Region region = explore_region(arm, request(5, last_segment_only));
  EXPECT_EQ(region.dimension, 2);
  EXPECT_NEAR(region.origin_in_base_m[0], 3.2, 1e-12);
  EXPECT_NEAR(region.farthest_m, 0.8, 1e-12);
  EXPECT_GT(region.nearest_m, 0.3);
  Random random(98);
  for (int trial = 0; trial < 5000; ++trial) {
    AngleVector theta{};
    theta[8] = random.uniform(-20.0, 20.0) * kDegree;
    theta[9] = random.uniform(-20.0, 20.0) * kDegree;
    const Vec3 seen = subtract(forward_kinematics(table, theta).tip_in_base.position_m, region.origin_in_base_m);
    const DirectionBin& bin = region.bins[direction_bin(seen)];
    EXPECT_GT(norm(seen), bin.inner.distance_m - 0.02);
    EXPECT_LT(norm(seen), bin.outer.distance_m + 0.02);
  }
}

TEST(Region, IsReachedByTheAnglesItNames) {
  const cable::RobotParams table = zhu2022::table();
  const ReachArm arm = arm_of(table);
  RegionRequest with_held = request(5, 0b0101000000);
  with_held.held_rad[6] = 3.0 * kDegree;
  const Region region = explore_region(arm, with_held);
  for (const DirectionBin& bin : region.bins) {
    if (bin.samples == 0) continue;
    for (const BoundaryPoint& end : {bin.outer, bin.inner}) {
      EXPECT_LT(norm(subtract(forward_kinematics(table, end.angle_rad).tip_in_base.position_m, end.point_in_base_m)),
                1e-12);
      for (std::size_t i = 0; i < zhu2022::kThetas; ++i)
        EXPECT_EQ(into_range(arm.range[i], end.angle_rad[i]), end.angle_rad[i]);
      EXPECT_EQ(end.angle_rad[6], with_held.held_rad[6]);
      EXPECT_EQ(end.angle_rad[8], 0.0);
    }
  }
}

// Only pitch moves the arm along y: every pitch angle that is held, from the root on, takes some of that away.
TEST(Region, ShrinksWithEveryPitchAngleThatIsHeld) {
  const ReachArm arm = arm_of(zhu2022::table());
  const Region all = explore_region(arm, request(5));
  double width_m = all.extent_m[1][1] - all.extent_m[0][1];
  for (const std::uint32_t held : {0b00000001u, 0b00000101u, 0b00010101u, 0b01010101u}) {
    const Region less = explore_region(arm, request(5, held));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_GE(less.extent_m[0][axis], all.extent_m[0][axis] - 2e-3);
      EXPECT_LE(less.extent_m[1][axis], all.extent_m[1][axis] + 2e-3);
    }
    const double less_m = less.extent_m[1][1] - less.extent_m[0][1];
    EXPECT_LT(less_m, width_m - 0.5) << held;
    width_m = less_m;
  }
}

TEST(Region, OfANodeDoesNotDependOnSegmentsBeyondIt) {
  const ReachArm arm = arm_of(zhu2022::table());
  const Region free = explore_region(arm, request(3));
  RegionRequest bent = request(3, 0b1111000000);
  bent.held_rad[7] = 0.2;
  const Region held = explore_region(arm, bent);
  ASSERT_EQ(free.samples.size(), held.samples.size());
  for (std::size_t i = 0; i < free.samples.size(); ++i) {
    EXPECT_LT(norm(subtract(free.samples[i].point_in_base_m, held.samples[i].point_in_base_m)), 1e-12);
  }
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(zhu2022::largest_difference(free.extent_m[i], held.extent_m[i]), 2e-3);
}

TEST(Region, HasTheDimensionThatTheFreeAnglesGive) {
  const ReachArm arm = arm_of(zhu2022::table());
  EXPECT_EQ(explore_region(arm, request(5, 0b1111111110)).dimension, 1);
  const Region plane = explore_region(arm, request(5, 0b1010101010));  // pitch only: stays in the x-y plane
  EXPECT_EQ(plane.dimension, 2);
  EXPECT_NEAR(plane.extent_m[1][2], 0.0, 1e-12);
  EXPECT_EQ(explore_region(arm, request(1)).dimension, 2);
}

TEST(Region, IsTheSameForTheSameSeedAndAnotherDrawForAnother) {
  const ReachArm arm = arm_of(zhu2022::table());
  const Region a = explore_region(arm, request(5)), b = explore_region(arm, request(5)),
               c = explore_region(arm, request(5, 0, 2));
  ASSERT_EQ(a.bins.size(), b.bins.size());
  for (std::size_t i = 0; i < a.bins.size(); ++i) EXPECT_EQ(a.bins[i].outer.angle_rad, b.bins[i].outer.angle_rad);
  EXPECT_NE(a.samples[7].point_in_base_m, c.samples[7].point_in_base_m);
}

// Seen from above, the arm goes straight back only with the pitch of its first segment on the limit; forwards it ends
// stretched out.
TEST(Outline, NamesTheFirstPitchBehindTheBaseAndNoLimitBeforeIt) {
  const Region region = explore_region(arm_of(zhu2022::table()), request(5));
  int behind = 0, behind_bound = 0;
  for (std::size_t k = 0; k < kOutlineSectors; ++k) {
    const OutlineSector& sector = region.outline[2][k];
    const double from_x_deg =
        std::fabs(std::remainder((static_cast<double>(k) + 0.5) * 360.0 / kOutlineSectors, 360.0));
    ASSERT_TRUE(sector.seen);
    if (from_x_deg < 90.0) {
      EXPECT_EQ(sector.outer_binding, 0u) << from_x_deg;
    }
    if (from_x_deg < 150.0) continue;
    ++behind;
    behind_bound += sector.outer_binding == 1u ? 1 : 0;
  }
  std::printf("measured: theta 1 binds in %d of %d sectors behind the base\n", behind_bound, behind);
  EXPECT_GE(2 * behind_bound, behind);
}

TEST(Outline, IsNeverInsideASampleOfItsSector) {
  const Region region = explore_region(arm_of(zhu2022::table()), request(5));
  double beyond_m = -1e9;
  for (const ReachedPoint& sample : region.samples) {
    const Vec3& p = sample.point_in_base_m;
    const double turns = std::atan2(p[1], p[0]) / (2.0 * std::numbers::pi);
    const OutlineSector& sector =
        region.outline[2][static_cast<std::size_t>((turns + 1.0) * kOutlineSectors) % kOutlineSectors];
    beyond_m = std::max(beyond_m, std::hypot(p[0], p[1]) - std::hypot(sector.outer_m[0], sector.outer_m[1]));
  }
  EXPECT_LE(beyond_m, 1e-9);  // the farthest one was pushed itself
}

TEST(Region, SharesOfShellsAndBindingsAddUp) {
  const Region region = explore_region(arm_of(zhu2022::table()), request(5));
  double shells = 0.0;
  for (const double share : region.shell_share) shells += share;
  EXPECT_NEAR(shells, 1.0, 1e-9);
  double most = 0.0;
  for (const double share : region.outer_binding_share) most = std::max(most, share);
  EXPECT_GT(most, 0.0);  // straight back, the first segment stands on its limits
  EXPECT_LE(region.outer_stretched_share + most, 1.0 + 1e-12);
}

}  // namespace
}  // namespace liana::workspace
