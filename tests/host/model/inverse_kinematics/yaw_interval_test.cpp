// The ways that yaws leave: where the planar part is reachable and inside the slit.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "host/model/inverse_kinematics/dof_split.hpp"
#include "tests/firmware_like/panel_slit.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using namespace inverse_kinematics;

using zhu2022::Random;

TEST(DofSplit, TheFrameOfThePanelSlitHasItsAxes) {
  const SlitMouth mouth = panel_slit();
  const Vec3 n = rotate(mouth.frame_in_base.quaternion, {0.0, 1.0, 0.0});
  EXPECT_NEAR(n[0], 0.0036, 1e-4);
  EXPECT_NEAR(n[1], 0.9925, 1e-4);
  EXPECT_NEAR(rotate(mouth.frame_in_base.quaternion, {0.0, 0.0, 1.0})[0], 0.0,
              1e-12);  // w is at right angles to base x
}

// Fitting judged anew, point by point along densely sampled links: inside the slit's depth everything within gap and
// width.
bool fits_by_sampling(const RobotParams& robot, const PlanarPart& part, const SlitMouth& mouth, double slack_m) {
  const LinkPoints links = link_points(robot, part.theta_rad);
  const Pose tip = forward_kinematics(robot, part.theta_rad).tip_in_base;
  const Pose shift = compose(part.tip_in_base, inverse(tip));
  const Pose to_mouth = compose(inverse(mouth.frame_in_base), shift);
  const std::int32_t first = links.count - 1 - 8 * part.segments;
  double s1_m = 0.0;
  for (std::int32_t m = 0; m < robot.segment_count - part.segments; ++m)
    s1_m += 8 * robot.segment[static_cast<std::size_t>(m)].module_length_m;
  const Vec3 root = compose(shift, {links.point_in_base[static_cast<std::size_t>(first)], {}}).position_m;
  if (norm(root) > s1_m + slack_m) return false;
  for (std::int32_t i = first; i + 1 < links.count; ++i) {
    const Vec3 a = compose(to_mouth, {links.point_in_base[static_cast<std::size_t>(i)], {}}).position_m;
    const Vec3 b = compose(to_mouth, {links.point_in_base[static_cast<std::size_t>(i + 1)], {}}).position_m;
    for (std::int32_t s = 0; s <= 100; ++s) {
      const Vec3 p = add(a, scale(subtract(b, a), s / 100.0));
      if (p[0] < slack_m || p[0] > mouth.depth_m - slack_m) continue;
      if (std::fabs(p[1]) > mouth.half_gap_m + slack_m || std::fabs(p[2]) > mouth.half_width_m + slack_m) return false;
    }
  }
  return true;
}

// Poses on the way from the panel edge to the rod, S2 of one and two segments: dense sampling agrees inside and outside
// the interval.
// req:A39
TEST(DofSplit, TheYawIntervalIsWhereS2IsReachableAndInsideTheSlit) {
  const RobotParams robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const ThetaVector rod = zhu2022::radians(zhu2022::kPressRod_deg);
  const Pose at_rod = forward_kinematics(robot, rod).tip_in_base;
  const Vec3 u = rotate(mouth.frame_in_base.quaternion, {1.0, 0.0, 0.0});
  std::int32_t bounded = 0;
  for (const std::int32_t segments : {1, 2}) {
    for (const double back_m : {0.0, 0.4, 0.8, 1.2}) {
      for (const double turn_rad : {0.0, 0.01}) {  // of the tip, out of the slit's plane
        PlanarPart part{segments, at_rod, rod};
        part.tip_in_base.position_m = subtract(part.tip_in_base.position_m, scale(u, back_m));
        part.tip_in_base.quaternion = multiply(part.tip_in_base.quaternion, quaternion_of({turn_rad, 0.0, turn_rad}));
        for (std::int32_t segment = 6 - segments; segment <= 5; ++segment) {
          const YawInterval interval = feasible_yaw(robot, part, mouth, segment);
          ASSERT_FALSE(interval.empty);
          const auto fits_at = [&](double yaw_rad, double slack_m) {
            PlanarPart trial = part;
            trial.theta_rad[static_cast<std::size_t>(2 * segment - 1)] = yaw_rad;
            return fits_by_sampling(robot, trial, mouth, slack_m);
          };
          for (std::int32_t i = 0; i <= 200; ++i) {
            const double yaw = interval.lowest_rad + i / 200.0 * (interval.highest_rad - interval.lowest_rad);
            ASSERT_TRUE(fits_at(yaw, 1e-3)) << segments << " " << back_m << " " << segment << " yaw " << yaw / kDegree;
          }
          const double limit = robot.segment[0].theta_limit_rad;
          for (const double beyond : {interval.lowest_rad - 1e-4, interval.highest_rad + 1e-4}) {
            if (std::fabs(beyond) > limit) continue;
            ++bounded;
            EXPECT_FALSE(fits_at(beyond, -1e-7))
                << segments << " " << back_m << " " << segment << " yaw " << beyond / kDegree;
          }
        }
      }
    }
  }
  EXPECT_GT(bounded, 5);  // geometry, not only the joint limits, has bounded some
}

// By hand: S2 is one segment of two links of 0.1 m, its root 0.1 m behind its middle joint. The tip 1.7 m before the
// base, S1 1.5 m long: with the middle joint bent by yaw b, the root is at (1.7 - 0.1 - 0.1 cos b, 0, -0.1 sin b)
// turned only by b; 1.6 - 0.1 cos b > 1.5 unless b = 0: one point. With 5 mm more of S1 it is |b| <= acos of (1.6^2 +
// 0.01 - 1.505^2) / 0.32.
TEST(DofSplit, TheYawIntervalOfTwoLinksIsThatOfTheTriangle) {
  RobotParams robot = zhu2022::table();
  robot.segment_count = 2;
  robot.segment[0].modules = 14;
  robot.segment[1].modules = 2;
  for (const double more_m : {0.0005, 0.002}) {
    robot.segment[0].module_length_m = (1.5 + more_m) / 14.0;
    PlanarPart part{1, {{1.7, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, {}};
    const YawInterval interval =
        feasible_yaw(robot, part, {{{10.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 1.0, 1.0, 1.0}, 2);
    const double cosine = (1.6 * 1.6 + 0.01 - (1.5 + more_m) * (1.5 + more_m)) / (2.0 * 1.6 * 0.1);
    const double expected = std::acos(cosine);
    ASSERT_FALSE(interval.empty);
    ASSERT_LT(expected, robot.segment[1].theta_limit_rad);
    EXPECT_NEAR(interval.highest_rad, expected, 1e-8);
    EXPECT_NEAR(interval.lowest_rad, -expected, 1e-8);
  }
}

TEST(DofSplit, AYawThatDoesNotFitGivesTheIntervalNearestToIt) {
  const RobotParams robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const ThetaVector rod = zhu2022::radians(zhu2022::kPressRod_deg);
  PlanarPart part{2, forward_kinematics(robot, rod).tip_in_base, rod};
  const YawInterval interval = feasible_yaw(robot, part, mouth, 4);
  ASSERT_FALSE(interval.empty);
  ASSERT_LT(interval.highest_rad, robot.segment[3].theta_limit_rad);
  part.theta_rad[7] = robot.segment[3].theta_limit_rad;
  const YawInterval again = feasible_yaw(robot, part, mouth, 4);
  ASSERT_FALSE(again.empty);
  EXPECT_NEAR(again.highest_rad, interval.highest_rad, 1e-8);
}

TEST(DofSplit, TheYawIntervalIsEmptyWhereNoYawFitsAndForOtherSegments) {
  const RobotParams robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const ThetaVector rod = zhu2022::radians(zhu2022::kPressRod_deg);
  PlanarPart part{1, forward_kinematics(robot, rod).tip_in_base, rod};
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 4).empty);
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 6).empty);
  part.tip_in_base.position_m = {6.0, 0.0, 0.0};  // S1 cannot carry the root there
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 5).empty);
  part.tip_in_base = forward_kinematics(robot, rod).tip_in_base;
  part.tip_in_base.quaternion =
      multiply(part.tip_in_base.quaternion, quaternion_of({0.0, 0.0, 0.5}));  // stands across the slit
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 5).empty);
}

}  // namespace
}  // namespace liana::cable
