#include "host/planning/workspace/push.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana::workspace {
namespace {

namespace zhu2022 = cable::zhu2022;
using zhu2022::Random;

constexpr PointOnArm kTip{.node = 5};

Vec3 place(const ReachArm& arm, const PointOnArm& point, const AngleVector& theta_rad) {
  return point_motion(arm, point, theta_rad).point_in_base_m;
}

void expect_within_limits(const ReachArm& arm, const AngleVector& theta_rad) {
  for (std::size_t i = 0; i < zhu2022::kThetas; ++i) EXPECT_EQ(into_range(arm.range[i], theta_rad[i]), theta_rad[i]);
}

TEST(ReachPosition, FindsPlacesNearbyWithHeldAnglesStillAndLimitsKept) {
  const cable::RobotParams table = zhu2022::table();
  const ReachArm arm = arm_of(table);
  const PointOnArm point{.node = 5, .held_mask = 0b0101000000};
  Random random(1);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const AngleVector start = random.theta(table, 18.0);
    const Vec3 target = add(place(arm, point, start), random.vector(0.05));
    AngleVector theta = start;
    if (!reach_position(arm, point, target, theta)) continue;
    ++found;
    EXPECT_LE(norm(subtract(place(arm, point, theta), target)), kReachTolerance_m);
    EXPECT_EQ(theta[6], start[6]);
    EXPECT_EQ(theta[8], start[8]);
    expect_within_limits(arm, theta);
  }
  EXPECT_GE(found, 195);
}

TEST(ReachPosition, SaysNoToAPlaceBeyondTheArmAndLeavesTheAnglesAlone) {
  const ReachArm arm = arm_of(zhu2022::table());
  const AngleVector start = zhu2022::radians(zhu2022::kPrepare_deg);
  AngleVector theta = start;
  EXPECT_FALSE(reach_position(arm, kTip, {4.001, 0.0, 0.0}, theta));
  EXPECT_EQ(theta, start);
}

TEST(Climb, AlongXStraightensTheArm) {
  const cable::RobotParams table = zhu2022::table();
  const ReachArm arm = arm_of(table);
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    AngleVector theta = random.theta(table, 6.0);
    climb(arm, kTip, {1.0, 0.0, 0.0}, theta);
    EXPECT_GT(place(arm, kTip, theta)[0], 3.999);
  }
}

TEST(Push, KeepsTheRayAndStopsAtTheStretchedArm) {
  const ReachArm arm = arm_of(zhu2022::table());
  AngleVector theta = zhu2022::radians(zhu2022::kPressRod_deg);
  const Vec3 start = place(arm, kTip, theta);
  push_along_ray(arm, kTip, {}, 1.0, theta);
  const Vec3 end = place(arm, kTip, theta);
  EXPECT_LT(norm(cross(scale(start, 1.0 / norm(start)), end)), 2.0 * kReachTolerance_m);
  EXPECT_GT(norm(end), 3.9);
  EXPECT_LT(norm(end), 4.0);
  EXPECT_EQ(binding_limits(arm, kTip, scale(end, 1.0 / norm(end)), theta), 0u);
}

TEST(Push, InwardsEndsAtTheOrigin) {
  const ReachArm arm = arm_of(zhu2022::table());
  AngleVector theta = zhu2022::radians({10, 10, 10, 5, 5, 0, 5, 0, 5, 0});
  push_along_ray(arm, kTip, {}, -1.0, theta);
  EXPECT_LT(norm(place(arm, kTip, theta)), kPushResolution_m);
}

TEST(Push, SeenAlongAnAxisGoesFurtherThanWithTheDepthKept) {
  const ReachArm arm = arm_of(zhu2022::table());
  const AngleVector start = zhu2022::radians(zhu2022::kPressRod_deg);
  const PointOnArm flat{.node = 5, .flat_axis = 2};
  AngleVector seen = start, kept = start;
  push_along_ray(arm, flat, {}, 1.0, seen);
  push_along_ray(arm, kTip, {}, 1.0, kept);
  const Vec3 a = place(arm, flat, seen), b = place(arm, kTip, kept);
  EXPECT_EQ(a[2], 0.0);
  EXPECT_GT(std::hypot(a[0], a[1]), std::hypot(b[0], b[1]));
}

TEST(BindingLimits, NameTheOnlyAngleThatIsLeftToMove) {
  const ReachArm arm = arm_of(zhu2022::table());
  const PointOnArm pitch_1_only{.node = 5, .held_mask = 0b1111111110};
  AngleVector theta{};
  theta[0] = 5.0 * kDegree;
  climb(arm, pitch_1_only, {-1.0, 0.0, 0.0}, theta);  // bends back until the limit
  EXPECT_DOUBLE_EQ(theta[0], arm.range[0].high_rad);
  EXPECT_EQ(binding_limits(arm, pitch_1_only, {-1.0, 0.0, 0.0}, theta), 1u);
  EXPECT_EQ(binding_limits(arm, pitch_1_only, {1.0, 0.0, 0.0}, theta), 0u);
}

}  // namespace
}  // namespace liana::workspace
