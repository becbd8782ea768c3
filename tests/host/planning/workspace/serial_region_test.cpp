// Regions of serial arms: of made-up tables against closed forms, of the small arm against what a study found.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/planning/workspace/region.hpp"
#include "tests/firmware_like/micro_arm.hpp"

namespace liana::workspace {
namespace {

namespace micro = serial::micro;

// An end is found to the resolution of a push, and lies at most the solver's tolerance beyond what is true.
void expect_end(double found_m, double true_m, double sign) {
  EXPECT_LE(sign * (found_m - true_m), 1e-5);
  EXPECT_GE(sign * (found_m - true_m), -2.0 * kPushResolution_m);
}

RegionRequest ask(std::int32_t node, std::uint64_t seed = 1) {
  RegionRequest out;
  out.point.node = node;
  out.samples = 5000;
  out.seed = seed;
  return out;
}

serial::JointParams pitch_joint(double length_m, double low_deg, double high_deg) {
  return {{0.0, length_m, 0.0, 0.0}, low_deg * kDegree, high_deg * kDegree, 0.1, 0.1};
}

// Two links in the plane z = 0, of 1 m and 0.6 m.
serial::RobotParams two_links(double low_deg, double high_deg) {
  serial::RobotParams table;
  table.joint_count = 2;
  table.joint[0] = pitch_joint(1.0, -270.0, 270.0);
  table.joint[1] = pitch_joint(0.6, low_deg, high_deg);
  return table;
}

// The same two links on a joint about z, so that their plane turns.
serial::RobotParams shoulder(double low_deg, double high_deg) {
  serial::RobotParams table = two_links(low_deg, high_deg);
  table.joint_count = 3;
  std::copy_backward(table.joint.begin(), table.joint.begin() + 2, table.joint.begin() + 3);
  table.joint[0] = {{90.0 * kDegree, 0.0, 0.0, 0.0}, -270.0 * kDegree, 270.0 * kDegree, 0.1, 0.1};
  return table;
}

// Distance of the tip of two links from their root by the law of cosines.
double two_links_m(double bend_deg) { return std::sqrt(1.0 + 0.36 + 1.2 * std::cos(bend_deg * kDegree)); }

// Of the tips of the small arm and of one with six joints in uneven ranges: found once, looked at by several tests.
const Region& micro_region() {
  static const Region region = explore_region(arm_of(micro::table()), ask(7));
  return region;
}
const Region& six_joint_region() {
  static const Region region = explore_region(arm_of(micro::six_joint_table()), ask(6));
  return region;
}

struct Explored {
  serial::RobotParams table;
  const Region& region;
};
std::array<Explored, 2> both_explored() {
  return {{{micro::table(), micro_region()}, {micro::six_joint_table(), six_joint_region()}}};
}

void expect_all_ends(const Region& region, double inner_m, double outer_m) {
  for (const DirectionBin& bin : region.bins) {
    if (bin.samples == 0) continue;
    expect_end(bin.outer.distance_m, outer_m, 1.0);
    expect_end(bin.inner.distance_m, inner_m, -1.0);
  }
}

TEST(SerialRegion, OfTwoLinksIsTheRingBetweenTheirDifferenceAndTheirSum) {
  const Region region = explore_region(arm_of(two_links(-270.0, 270.0)), ask(2));
  EXPECT_EQ(region.dimension, 2);
  EXPECT_DOUBLE_EQ(region.length_m, 1.6);
  expect_end(region.farthest_m, 1.6, 1.0);
  expect_end(region.nearest_m, 0.4, -1.0);
  EXPECT_NEAR(region.extent_m[0][1], -1.6, 1e-6);
  EXPECT_NEAR(region.extent_m[1][1], 1.6, 1e-6);
  expect_all_ends(region, 0.4, 1.6);
  EXPECT_EQ(region.outer_stretched_share, 1.0);
}

TEST(SerialRegion, OfTwoLinksThatNeverStretchEndsWhereTheirJointDoesAndNamesIt) {
  const Region region = explore_region(arm_of(two_links(30.0, 150.0)), ask(2));
  expect_all_ends(region, two_links_m(150.0), two_links_m(30.0));
  EXPECT_EQ(region.outer_binding_share[1], 1.0);
  EXPECT_EQ(region.outer_binding_share[0], 0.0);  // it turns further than once
  EXPECT_EQ(region.outer_stretched_share, 0.0);
}

TEST(SerialRegion, OfAShoulderAndTwoLinksIsAHollowBallWhollyReached) {
  const Region free = explore_region(arm_of(shoulder(-180.0, 180.0)), ask(3));
  const Region bent = explore_region(arm_of(shoulder(-150.0, -30.0)), ask(3));
  EXPECT_EQ(free.dimension, 3);
  for (std::size_t i = 0; i < free.bins.size(); ++i) {
    EXPECT_GT(free.bins[i].samples, 0);
    EXPECT_GT(bent.bins[i].samples, 0);
  }
  expect_all_ends(free, 0.4, 1.6);
  expect_all_ends(bent, two_links_m(150.0), two_links_m(30.0));
  EXPECT_EQ(free.outer_stretched_share, 1.0);
  EXPECT_EQ(bent.outer_binding_share[2], 1.0);
}

TEST(SerialRegion, OfOneJointIsAnArcAsLongAsItsRange) {
  serial::RobotParams table;
  table.joint_count = 1;
  table.joint[0] = pitch_joint(1.0, -30.0, 120.0);
  const Region arc = explore_region(arm_of(table), ask(1));
  EXPECT_EQ(arc.dimension, 1);
  EXPECT_NEAR(arc.extent_m[0][0], std::cos(120.0 * kDegree), 1e-6);
  EXPECT_NEAR(arc.extent_m[1][0], 1.0, 1e-6);
  EXPECT_NEAR(arc.extent_m[0][1], std::sin(-30.0 * kDegree), 1e-6);
  EXPECT_NEAR(arc.extent_m[1][1], 1.0, 1e-6);
}

// A joint that comes to every place in two ways is drawn over one turn: nothing is drawn twice as often as the rest.
TEST(SerialRegion, OfJointsThatTurnFurtherThanOnceIsDrawnAsOfThoseThatTurnOnce) {
  const Region once = explore_region(arm_of(two_links(-180.0, 180.0)), ask(2));
  const Region further = explore_region(arm_of(two_links(-270.0, 270.0)), ask(2));
  ASSERT_EQ(once.samples.size(), further.samples.size());
  for (std::size_t i = 0; i < once.samples.size(); ++i)
    EXPECT_LT(norm(subtract(once.samples[i].point_in_base_m, further.samples[i].point_in_base_m)), 1e-9);
}

TEST(SerialRegion, OfThePointsOfJointsGrowsFromNothingToAVolume) {
  const ReachArm arm = arm_of(micro::table());
  EXPECT_EQ(explore_region(arm, ask(1)).dimension, 0);  // on the first joint's axis
  const Region circle = explore_region(arm, ask(2));
  EXPECT_EQ(circle.dimension, 1);
  EXPECT_NEAR(circle.farthest_m, std::hypot(0.28, 0.22), 1e-9);
  EXPECT_NEAR(circle.nearest_m, std::hypot(0.28, 0.22), 1e-9);
  EXPECT_EQ(explore_region(arm, ask(3)).dimension, 3);
  EXPECT_EQ(micro_region().dimension, 3);
}

// The payload study found 4.93 m from the base flange to the tip; climbing by finite differences over a kinematics of
// its own 4.9312 m, and 4.8551 m along the first joint's axis.
// req:B1
TEST(SerialRegion, OfTheSmallArmEndsAtTheWorkingRadiusOfTheStudy) {
  const Region& region = micro_region();
  expect_end(region.farthest_m, 4.9312, 1.0);
  EXPECT_NEAR(region.extent_m[1][2], 4.8551, 1e-3);
  EXPECT_LT(region.nearest_m, kPushResolution_m);
  EXPECT_DOUBLE_EQ(region.length_m, chain_length_m(micro::table()));
  EXPECT_EQ(region.outer_stretched_share, 1.0);  // every joint turns further than once
}

// The first joint turns further than once about z: what is reached at one azimuth is reached at every other.
TEST(SerialRegion, OfTheSmallArmIsAsWideAllAroundItsFirstAxis) {
  const Region& region = micro_region();
  for (const double end_m : {-region.extent_m[0][0], -region.extent_m[0][1], region.extent_m[1][1]})
    EXPECT_NEAR(end_m, region.extent_m[1][0], 2e-3);
}

TEST(SerialRegion, IsReachedByAnglesWithinTheirRanges) {
  for (const auto& [table, region] : both_explored()) {
    for (const DirectionBin& bin : region.bins) {
      if (bin.samples == 0) continue;
      for (const BoundaryPoint& end : {bin.outer, bin.inner}) {
        serial::JointVector joint_rad{};
        std::copy_n(end.angle_rad.begin(), joint_rad.size(), joint_rad.begin());
        EXPECT_TRUE(micro::within_ranges(table, joint_rad));
        const Vec3 tip_m = forward_kinematics(table, joint_rad).tip_in_base.position_m;
        EXPECT_LT(norm(subtract(tip_m, end.point_in_base_m)), 1e-12);
      }
    }
  }
}

// What was found with one draw holds for another: a bin of 15 deg mixes rays of different length, hence the margin.
TEST(SerialRegion, ContainsEveryPoseOfAnotherDraw) {
  for (const auto& [table, region] : both_explored()) {
    micro::Random random(99);
    double beyond_m = -1e9, inside_m = -1e9;
    for (int trial = 0; trial < 20000; ++trial) {
      const Vec3 tip_m = forward_kinematics(table, micro::random_joints(table, random)).tip_in_base.position_m;
      const DirectionBin& bin = region.bins[direction_bin(tip_m)];
      ASSERT_GT(bin.samples, 0);
      beyond_m = std::max(beyond_m, norm(tip_m) - bin.outer.distance_m);
      inside_m = std::max(inside_m, bin.inner.distance_m - norm(tip_m));
    }
    std::printf("measured: %d joints: farthest pose beyond its bin %.4f m, before its inner end %.4f m\n",
                table.joint_count, beyond_m, inside_m);
    EXPECT_LT(beyond_m, 0.05);
    EXPECT_LT(inside_m, 0.05);
  }
}

// An end without a limit is one where the arm is stretched out or folded: hardly any joint rate takes the tip further.
TEST(SerialRegion, EndsWithoutALimitOnlyWhereTheArmIsStretchedOrFolded) {
  for (const auto& [table, region] : both_explored()) {
    const ReachArm arm = arm_of(table);
    double max_m_per_rad = 0.0;
    for (const DirectionBin& bin : region.bins) {
      if (bin.samples == 0 || bin.outer.binding != 0) continue;
      const PointMotion motion = point_motion(arm, {.node = arm.node_count}, bin.outer.angle_rad);
      double square = 0.0;
      for (const Vec3& column : motion.column) {
        const double along = dot(column, bin.outer.point_in_base_m) / bin.outer.distance_m;
        square += along * along;
      }
      max_m_per_rad = std::max(max_m_per_rad, std::sqrt(square));
    }
    std::printf("measured: %d joints: outwards at most %.4f m/rad\n", table.joint_count, max_m_per_rad);
    EXPECT_LT(max_m_per_rad, 0.6);
  }
}

TEST(SerialRegion, IsTheSameForTheSameSeedAndAnotherDrawForAnother) {
  const Region& a = micro_region();
  const Region b = explore_region(arm_of(micro::table()), ask(7));
  ASSERT_EQ(a.bins.size(), b.bins.size());
  for (std::size_t i = 0; i < a.bins.size(); ++i) {
    EXPECT_EQ(a.bins[i].outer.angle_rad, b.bins[i].outer.angle_rad);
    EXPECT_EQ(a.bins[i].inner.angle_rad, b.bins[i].inner.angle_rad);
  }
  EXPECT_EQ(a.extent_m, b.extent_m);
  const ReachArm arm = arm_of(two_links(-180.0, 180.0));
  EXPECT_NE(explore_region(arm, ask(2)).samples[7].point_in_base_m,
            explore_region(arm, ask(2, 2)).samples[7].point_in_base_m);
}

// The base is inside: no direction has a hole, though starts of some meet a fold before they come there.
TEST(SerialRegion, OfTheSmallArmHasNoHoleAroundTheBase) {
  for (const DirectionBin& bin : micro_region().bins) EXPECT_LT(bin.inner.distance_m, 2.0 * kPushResolution_m);
}

}  // namespace
}  // namespace liana::workspace
