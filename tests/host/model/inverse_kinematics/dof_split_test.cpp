// Dynamic combination of degrees of freedom: equation 13, and the switch point.
#include "host/model/inverse_kinematics/dof_split.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "tests/firmware_like/panel_slit.hpp"
#include "tests/firmware_like/pose_of_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using namespace inverse_kinematics;

using zhu2022::bit;
using zhu2022::Random;

// ---- equation 13 ----

// req:A39
TEST(DofSplit, TheRootOfTheLastSegmentsFollowsFromTheTipAndTheirAngles) {
  for (const RobotParams& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    Random random(7);
    for (std::int32_t i = 0; i < 100; ++i) {
      const ThetaVector theta = random.theta(robot, 20.0);
      const ArmKinematics arm = forward_kinematics(robot, theta);
      for (std::int32_t segments = 0; segments <= robot.segment_count; ++segments) {
        PlanarPart part{segments, arm.tip_in_base, theta};
        // Nothing of S1 is known.
        for (std::int32_t k = 0; k < 2 * (robot.segment_count - segments); ++k)
          part.theta_rad[static_cast<std::size_t>(k)] = 0.3;
        const Pose& root = arm.node_in_base[static_cast<std::size_t>(robot.segment_count - segments)];
        ASSERT_LE(pose_difference(root_of(robot, part), root), 1e-13) << segments;
      }
    }
  }
}

// To its end: S2's pose fixed, S1 solved for S2's root; together they put the tip where it should be.
// req:A39
TEST(DofSplit, SolvingTheFirstSegmentsForTheRootOfTheOthersPutsTheTipOnItsGoal) {
  const RobotParams robot = zhu2022::table();
  RobotParams first = robot;
  first.segment_count = 4;
  ThetaVector theta = zhu2022::radians(zhu2022::kPressRod_deg);
  const Pose goal = forward_kinematics(robot, theta).tip_in_base;
  for (const double pitch_deg : {0.0, 1.0, -2.0}) {
    theta[8] = pitch_deg * kDegree;
    GoalIkProblem problem;
    problem.tip_in_base = root_of(robot, {1, goal, theta});
    problem.from_rad = theta;
    const GoalIkResult solved = solve_goal(first, problem);
    ASSERT_TRUE(solved.converged) << pitch_deg;
    ThetaVector whole = solved.theta_rad;
    whole[8] = theta[8];
    whole[9] = theta[9];
    EXPECT_LE(pose_difference(forward_kinematics(robot, whole).tip_in_base, goal), 1e-6) << pitch_deg;
  }
}

TEST(DofSplit, PlanarPitchesAreThoseOfTheLastSegments) {
  const RobotParams robot = zhu2022::table();
  EXPECT_EQ(planar_pitches(robot, 0), 0u);
  EXPECT_EQ(planar_pitches(robot, 1), bit(9));
  EXPECT_EQ(planar_pitches(robot, 2), bit(7) | bit(9));
  EXPECT_EQ(planar_pitches(robot, 5), bit(1) | bit(3) | bit(5) | bit(7) | bit(9));
}

// ---- the switch point
// -----------------------------------------------------------------------------------------------------------------

// A straight arm along x into a slit whose mouth is at `mouth_m`.
std::int32_t planar_of_straight_arm(double mouth_m, const PlanarSwitch& when, std::int32_t before) {
  const RobotParams robot = zhu2022::table();
  const SlitMouth mouth{{{mouth_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 2.0, 0.02, 1.0};
  return planar_segments(robot, link_points(robot, ThetaVector{}), mouth, when, before);
}

// req:A40
TEST(DofSplit, SegmentsBecomePlanarBeforeTheyReachTheMouth) {
  const PlanarSwitch when{0.2, 0.05};
  EXPECT_EQ(planar_of_straight_arm(4.25, when, 0), 0);  // the tip is at 4 m: 10+0
  EXPECT_EQ(planar_of_straight_arm(4.15, when, 0), 1);  // 9+1
  EXPECT_EQ(planar_of_straight_arm(3.45, when, 0), 1);  // segment 4 ends at 3.2 m
  EXPECT_EQ(planar_of_straight_arm(3.35, when, 1), 2);  // 8+2
  EXPECT_EQ(planar_of_straight_arm(2.55, when, 2), 3);
}

// req:A40
TEST(DofSplit, OnTheWayOutSegmentsAreReleasedFartherAwayThanTheyWereTaken) {
  const PlanarSwitch when{0.2, 0.05};
  for (const auto& [gap_m, entering, leaving] : {std::tuple{0.19, 1, 1}, {0.22, 0, 1}, {0.24, 0, 1}, {0.26, 0, 0}}) {
    EXPECT_EQ(planar_of_straight_arm(4.0 + gap_m, when, 0), entering) << gap_m;
    EXPECT_EQ(planar_of_straight_arm(4.0 + gap_m, when, 1), leaving) << gap_m;
  }
}

TEST(DofSplit, AnArmBesideOrBehindTheSlitNeedsNoPlanarSegments) {
  const RobotParams robot = zhu2022::table();
  const LinkPoints links = link_points(robot, ThetaVector{});
  const PlanarSwitch when{0.2, 0.05};
  const Quat level{1.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(planar_segments(robot, links, {{{2.0, 0.5, 0.0}, level}, 2.0, 0.02, 1.0}, when, 0), 0);
  EXPECT_EQ(planar_segments(robot, links, {{{2.0, 0.0, 1.5}, level}, 2.0, 0.02, 1.0}, when, 0), 0);
  EXPECT_EQ(planar_segments(robot, links, {{{-3.0, 0.0, 0.0}, level}, 2.0, 0.02, 1.0}, when, 0), 0);
}

// The published poses: nothing planar at the panel edge, segments 4 and 5 at the press rod.
// req:A40
TEST(DofSplit, ThePublishedPosesGetTheirCombinations) {
  const RobotParams robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const auto planar_at = [&](const zhu2022::Degrees& theta_deg) {
    return planar_segments(robot, link_points(robot, zhu2022::radians(theta_deg)), mouth, PlanarSwitch{}, 0);
  };
  EXPECT_EQ(planar_at(zhu2022::kPrepare_deg), 0);
  EXPECT_EQ(planar_at(zhu2022::kPanelEdge_deg), 0);
  EXPECT_EQ(planar_at(zhu2022::kPressRod_deg), 2);  // segment 3 reaches 0.21 m into the mouth, and bends
}

}  // namespace
}  // namespace liana::cable
