#include "host/planning/workspace/path.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana::workspace {
namespace {

namespace zhu2022 = cable::zhu2022;
using zhu2022::radians;

PathStatus at(const zhu2022::Degrees& theta_deg, std::uint32_t held_mask = 0) {
  return examine_path(zhu2022::table(), {radians(theta_deg)}, held_mask);
}

// Reference: an independent study of this arm gives 20.4 .. 4.10 at prepare and 21.0 .. 2.90 at panel edge (m/rad and
// rad/rad).
TEST(Conditioning, AgreesWithAnIndependentStudyAtThePublishedPoses) {
  const PathPoint prepare = at(zhu2022::kPrepare_deg).points.front();
  EXPECT_NEAR(prepare.largest_singular_value, 20.4, 0.05);
  EXPECT_NEAR(prepare.least_singular_value, 4.10, 0.005);
  const PathPoint edge = at(zhu2022::kPanelEdge_deg).points.front();
  EXPECT_NEAR(edge.largest_singular_value, 21.0, 0.05);
  EXPECT_NEAR(edge.least_singular_value, 2.90, 0.005);
}

TEST(Conditioning, TheStraightArmIsSingular) {
  const PathPoint straight = at({}).points.front();
  EXPECT_LT(straight.least_singular_value, 1e-12);
  EXPECT_TRUE(std::isinf(condition_number(straight)));
}

TEST(Conditioning, HoldingAnAngleNeverHelps) {
  const cable::RobotParams table = zhu2022::table();
  zhu2022::Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const cable::ThetaVector theta = random.theta(table, 20.0);
    double before = 1e9;
    for (const std::uint32_t held : {0u, 0b0100000000u, 0b0101000000u}) {
      const double now = examine_path(table, {theta}, held).points.front().least_singular_value;
      EXPECT_LE(now, before + 1e-12);
      before = now;
    }
  }
}

TEST(Conditioning, WithFewerThanSixFreeAnglesSomeMotionIsImpossible) {
  EXPECT_LT(at(zhu2022::kPanelEdge_deg, 0b0000011111).points.front().least_singular_value, 1e-12);
}

TEST(Path, NamesTheAngleNearestToItsLimitAndWhere) {
  const PathStatus report =
      examine_path(zhu2022::table(), {radians({1, 2}), radians({1, 2, 0, -19}), radians({1, 2, 0, -4})}, 0);
  const PathPoint& nearest = report.points[report.nearest_limit];
  EXPECT_EQ(nearest.nearest_theta, 4);
  EXPECT_NEAR(nearest.limit_margin_rad, 1.0 * kDegree, 1e-12);
  EXPECT_NEAR(nearest.way, 19.0 / 34.0, 1e-12);
  EXPECT_EQ(report.points.front().nearest_theta, 2);
}

TEST(Path, HeldAnglesDoNotCountAsNearALimit) {
  const PathStatus report = examine_path(zhu2022::table(), {radians({1, 2, 0, -19})}, 0b1000);
  EXPECT_EQ(report.points.front().nearest_theta, 2);
  EXPECT_NEAR(report.points.front().limit_margin_rad, 18.0 * kDegree, 1e-12);
}

TEST(Path, IsExaminedFromEndToEndInStepsWithinItsResolution) {
  const std::vector<cable::ThetaVector> waypoints{radians(zhu2022::kPrepare_deg), radians(zhu2022::kPanelEdge_deg),
                                                  radians(zhu2022::kPressRod_deg)};
  const PathStatus report = examine_path(zhu2022::table(), waypoints, 0);
  EXPECT_EQ(report.points.front().theta_rad, waypoints.front());
  EXPECT_EQ(report.points.back().theta_rad, waypoints.back());
  EXPECT_DOUBLE_EQ(report.points.back().way, 1.0);
  ASSERT_EQ(report.waypoint_way.size(), 3u);
  for (std::size_t i = 1; i < report.points.size(); ++i) {
    EXPECT_GT(report.points[i].way, report.points[i - 1].way);
    EXPECT_LE(zhu2022::largest_difference(report.points[i].theta_rad, report.points[i - 1].theta_rad),
              kPathStep_rad * (1.0 + 1e-9));
  }
  for (const PathPoint& point : report.points) {
    EXPECT_GE(point.least_singular_value, report.points[report.worst_conditioned].least_singular_value);
  }
}

TEST(Path, ThatStandsStillIsOnePoseExaminedTwice) {
  const PathStatus report =
      examine_path(zhu2022::table(), {radians(zhu2022::kPrepare_deg), radians(zhu2022::kPrepare_deg)}, 0);
  EXPECT_EQ(report.joint_travel_rad, 0.0);
  ASSERT_EQ(report.points.size(), 2u);
  EXPECT_EQ(report.points.back().way, 0.0);
}

}  // namespace
}  // namespace liana::workspace
