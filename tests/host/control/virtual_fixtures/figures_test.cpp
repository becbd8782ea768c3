// The figures by which fixtures are felt and told: the pitch budget, and how far a tip is beyond a wall.
#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/control/virtual_fixtures/forbidden.hpp"
#include "host/control/virtual_fixtures/pitch_budget.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::virtual_fixtures {
namespace {

// req:A47
TEST(PitchBudget, Leaves320MillidegreesToOneSegmentAnd84ToTwoFor20Millimetres) {
  const RobotParams robot = zhu2022::table();
  EXPECT_NEAR(pitch_lever_m(robot, 1), 3.6, 1e-12);
  EXPECT_NEAR(pitch_lever_m(robot, 2), 13.6, 1e-12);
  EXPECT_NEAR(pitch_budget(robot, 1, 0.02, {}, {}).allowed_rad / kDegree, 0.32, 0.005);
  EXPECT_NEAR(pitch_budget(robot, 2, 0.02, {}, {}).allowed_rad / kDegree, 0.084, 0.0005);
  EXPECT_EQ(pitch_budget(robot, 0, 0.02, {}, {}).allowed_rad, 0.0);
}

TEST(PitchBudget, UsesTheLargestErrorOfThePlanarPitchesAlone) {
  const RobotParams robot = zhu2022::table();
  ThetaVector believed{}, commanded{};
  believed[4] = 0.1;  // segment 3 is free
  believed[9] = 0.1;  // a yaw
  believed[6] = -0.0005;
  believed[8] = 0.0007;
  commanded[8] = 0.0003;
  const PitchBudget two = pitch_budget(robot, 2, 0.02, believed, commanded);
  EXPECT_NEAR(two.used_rad, 0.0005, 1e-12);
  EXPECT_NEAR(two.left_m(pitch_lever_m(robot, 2)), 0.02 - 0.0005 * 13.6, 1e-12);
  EXPECT_NEAR(pitch_budget(robot, 1, 0.02, believed, commanded).used_rad, 0.0004, 1e-12);
}

TEST(BeyondWalls, IsCountedFromTheArmsSurfaceAndOnlyInTheFixturesBox) {
  config::SceneFixture walls{"walls", config::FixtureKind::kWalls, {{1.0, 0.5, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 2.0, 1.0,
                             0.05};
  config::SceneFixture plane = walls;
  plane.kind = config::FixtureKind::kPlane;
  struct Row {
    const char* what;
    Vec3 tip_m;
    bool is_in;
    double depth_m;
    bool is_between;
  };
  for (const Row& row :
       {Row{"in the middle", {2.0, 0.5, 0.0}, true, -0.02, true}, Row{"beside", {2.0, 0.525, 0.0}, true, 0.005, true},
        Row{"on the other side", {2.0, 0.47, 0.5}, true, 0.01, true},
        Row{"behind a wall", {2.0, 0.6, 0.5}, true, 0.08, false}, Row{"before it", {0.99, 0.6, 0.0}, false, 0.0, false},
        Row{"past its end", {3.01, 0.6, 0.0}, false, 0.0, false},
        Row{"past its width", {2.0, 0.6, 1.01}, false, 0.0, false}}) {
    EXPECT_FALSE(beyond_walls(plane, 0.03, {}, row.tip_m)) << row.what;
    const auto beyond = beyond_walls(walls, 0.03, {}, row.tip_m);
    ASSERT_EQ(beyond.has_value(), row.is_in) << row.what;
    if (beyond) {
      EXPECT_NEAR(beyond->depth_m, row.depth_m, 1e-12) << row.what;
      EXPECT_EQ(beyond->is_between, row.is_between) << row.what;
    }
  }
}

TEST(BeyondWalls, StandWhereTheSceneIsSeenToStand) {
  const config::SceneFixture walls{"walls", config::FixtureKind::kWalls, {}, 2.0, 1.0, 0.05};
  EXPECT_NEAR(beyond_walls(walls, 0.03, {{0.0, 0.01, 0.0}}, {1.0, 0.0, 0.0})->depth_m, -0.01, 1e-12);
}

}  // namespace
}  // namespace liana::virtual_fixtures
