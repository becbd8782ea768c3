// A way that is about to be gone is refused by the piece that is wrong.
#include "host/planning/planner/check/way_check.hpp"

#include <gtest/gtest.h>

#include "firmware_like/math/trig.hpp"
#include "host/planning/planner/check/plan_check.hpp"
#include "tests/host/planning/planner/requests.hpp"
#include "tests/message.hpp"

namespace liana::planner {
namespace {

constexpr double kMargin_m = 0.005, kOff_m = 0.001, kSphere_m = 0.01;

// The arm bent up evenly; the tip goes along an arc.
ThetaVector bent(double pitch_deg) {
  ThetaVector theta{};
  for (std::size_t m = 0; m < 5; ++m) theta[2 * m] = pitch_deg * kDegree;
  return theta;
}

// A small sphere so far beyond the tip of a pose, in the direction of its last link.
config::SceneConfig scene_with_sphere(const ThetaVector& theta, double clearance_m) {
  const auto axis = plain_axis(zhu2022::table(), theta);
  const Vec3 tip = axis.back(), along = subtract(tip, axis[axis.size() - 2]);
  config::SceneConfig scene;
  config::SceneSphere sphere;
  sphere.name = "ball";
  sphere.radius_m = kSphere_m;
  sphere.center_m = add(tip, scale(along, (0.03 + kSphere_m + clearance_m) / norm(along)));
  scene.spheres.push_back(sphere);
  return scene;
}

std::string refusal(const config::SceneConfig& scene, const std::vector<ThetaVector>& points) {
  return refusal_of_way(robot_of(zhu2022::table()), scene, points, kMargin_m, kOff_m);
}

TEST(WayCheck, AFreeWayIsNotRefused) {
  EXPECT_EQ(refusal(config::SceneConfig{}, {bent(1.0), bent(1.0), bent(2.0), bent(3.0)}), "");
  EXPECT_EQ(refusal(config::SceneConfig{}, {bent(1.0), bent(1.0)}), "") << "of one point";
}

TEST(WayCheck, AnObstacleBetweenTwoPointsNamesThem) {
  const std::vector<ThetaVector> way{bent(1.0), bent(1.0), bent(2.0), bent(3.0), bent(4.0)};
  const std::string found = refusal(scene_with_sphere(bent(2.5), -0.01), way);
  EXPECT_TRUE(names(found, {"points 2 and 3", "link 40", "ball", "5.00 mm"}));
}

TEST(WayCheck, TheWayToTheFirstPointNeedsOnlyRoomForTheMotionItself) {
  const auto near = [](double clearance_m) { return scene_with_sphere(bent(1.0), clearance_m); };
  EXPECT_EQ(refusal(near(0.0045), {bent(1.0), bent(1.5), bent(2.0)}), "");
  const std::string found = refusal(near(0.001), {bent(1.0), bent(1.5), bent(2.0)});
  EXPECT_TRUE(names(found, {"point 1", "link 40", "ball"}));
  EXPECT_NE(refusal(near(0.0045), {bent(1.0), bent(1.0), bent(1.5)}), "") << "points need the margin";
}

TEST(WayCheck, AMoveIsRefusedWithHowFarItCouldGo) {
  const auto move = [](const config::SceneConfig& scene, double from_deg, double goal_deg) {
    return refusal_of_move(robot_of(zhu2022::table()), scene, bent(from_deg), bent(goal_deg));
  };
  EXPECT_EQ(move(config::SceneConfig{}, 1.0, 8.0), "");
  EXPECT_TRUE(names(move(config::SceneConfig{}, 1.0, 18.0), {"% of the straight way", "arm itself"}));
  EXPECT_TRUE(names(move(scene_with_sphere(bent(3.0), -0.02), 1.0, 4.0), {"% of the straight way", "ball"}));
  EXPECT_EQ(move(scene_with_sphere(bent(3.0), 0.001), 3.0, 1.0), "") << "away from where it stands";
}

TEST(WayCheck, AMoveThatAsksTooMuchOfACableIsRefusedWithItsTension) {
  const config::RobotConfig robot = robot_of(zhu2022::table());
  ThetaVector corner{};
  for (std::size_t i = 0; i < zhu2022::kThetas; ++i)
    corner[i] = (i % 4 < 2 ? 1.0 : -1.0) * robot.table.segment[i / 2].theta_limit_rad;
  EXPECT_TRUE(names(refusal_of_move(robot, {}, ThetaVector{}, corner), {"% of the straight way", "150.0 N"}));
  ThetaVector half = corner;
  for (double& theta_rad : half) theta_rad *= 0.5;
  EXPECT_EQ(refusal_of_move(robot, {}, corner, half), "") << "it stands there, and is let out";
}

TEST(WayCheck, AnArmThatWouldLieInItselfIsRefused) {
  const std::string found = refusal(config::SceneConfig{}, {bent(10.0), bent(10.0), bent(18.0)});
  EXPECT_TRUE(names(found, {"link 40", "link 5", "arm itself"}));
}

}  // namespace
}  // namespace liana::planner
