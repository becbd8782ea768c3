// The independent check against the core's kinematics, dense sampling, and paths that are wrong on purpose.
#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/check/path_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/kinematics.hpp"
#include "host/model/clearance/arm_clearance.hpp"
#include "host/model/config/convex_shape.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/planning/planner/requests.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

config::SceneConfig ball_and_box() {
  config::SceneConfig scene;
  scene.spheres.push_back({"ball", {1.6, 0.9, 0.5}, 0.25});
  const Quat q = quaternion_of({0.3, -0.5, 0.2});
  scene.boxes.push_back(
      {"box", {1.5, -1.0, 0.2}, {0.4, 0.02, 0.3}, {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1})}});
  return scene;
}

PlanCheck check(const RobotParams& table, const config::SceneConfig& scene, const std::vector<ThetaVector>& path) {
  return check_plan(robot_of(table), scene, path, plain_tip(table, path.back()));
}

TEST(PlanCheck, KnowsTheSameTipAsTheCore) {
  for (const RobotParams& table : {zhu2022::table(), zhu2022::uneven_table()}) {
    zhu2022::Random random(1);
    for (int i = 0; i < 100; ++i) {
      const ThetaVector theta = random.theta(table, 19.0);
      const CheckedTip plain = plain_tip(table, theta);
      const Pose core = forward_kinematics(table, theta).tip_in_base;
      EXPECT_LT(zhu2022::largest_difference(plain.position_m, core.position_m), 1e-12);
      double cosine = 0.0;
      for (Index k = 0; k < 4; ++k) cosine += plain.quaternion_wxyz[k] * core.quaternion[k];
      EXPECT_NEAR(std::fabs(cosine), 1.0, 1e-12);
    }
  }
}

// libccd, which the check asks, against the search of host/model/clearance.
TEST(PlanCheck, FindsTheClearanceFromConvexBodiesThatThePlannerFinds) {
  const RobotParams table = zhu2022::table();
  config::SceneConfig scene;
  scene.convex = {config::hull_of("wedge", {{1.4, 0.8, 0.3}, {1.9, 0.8, 0.3}, {1.6, 1.2, 0.3}, {1.6, 0.9, 0.9}}),
                  config::cylinder("tank", {1.5, -1.2, 0.0}, {1.8, -0.9, 0.4}, 0.15),
                  config::capsule("hose", {2.5, 0.3, -1.0}, {2.9, -0.2, -0.6}, 0.05)};
  zhu2022::Random random(7);
  int near = 0;
  for (int i = 0; i < 300; ++i) {
    const ThetaVector theta = random.theta(table, 12.0);
    const double found_m = check(table, scene, {theta}).min_clearance_m;
    const double planner_m = clearance::arm_clearance(link_points(table, theta).axis(), 0.03, scene).distance_m();
    if (planner_m < -0.02) {
      EXPECT_LT(found_m, 0.0);
      continue;
    }
    EXPECT_NEAR(found_m, planner_m, 5e-6);
    near += planner_m < 0.1 ? 1 : 0;
  }
  EXPECT_GT(near, 10);
}

TEST(PlanCheck, FindsTheLeastClearanceThatDenseSamplingFinds) {
  const RobotParams table = zhu2022::table();
  const config::SceneConfig scene = ball_and_box();
  zhu2022::Random random(2);
  for (int i = 0; i < 20; ++i) {
    const std::vector<ThetaVector> path{random.theta(table, 6.0), random.theta(table, 6.0)};
    double sampled_m = 1e3;
    for (int s = 0; s <= 2000; ++s) {
      ThetaVector theta{};
      for (Index k = 0; k < theta.size(); ++k) theta[k] = path[0][k] + (path[1][k] - path[0][k]) * s / 2000.0;
      sampled_m = std::min(sampled_m,
                           clearance::arm_clearance(link_points(table, theta).axis(), 0.03, scene).nearest.distance_m);
    }
    const double found_m = check(table, scene, path).min_clearance_m;
    if (sampled_m < -0.03)
      continue;  // inside a body depth is measured to the nearest face, which a search along the link may miss
    EXPECT_GT(found_m, sampled_m - 0.005);  // samples are up to 5 mm of motion apart
    EXPECT_LT(found_m, sampled_m + kUnseen_m + 1e-6);
  }
}

TEST(PlanCheck, SeesACollisionBetweenTwoFreeWaypoints) {
  const RobotParams table = zhu2022::table();
  config::SceneConfig scene;
  scene.spheres.push_back({"ball", {3.6, 0.0, 0.0}, 0.05});  // the straight arm goes through it
  ThetaVector left{}, right{};
  left[1] = 3.0 * kDegree;
  right[1] = -3.0 * kDegree;
  EXPECT_GT(check(table, scene, {left}).min_clearance_m, 0.1);
  EXPECT_GT(check(table, scene, {right}).min_clearance_m, 0.1);
  const PlanCheck found = check(table, scene, {left, right});
  EXPECT_LT(found.min_clearance_m, -0.02);
  EXPECT_EQ(found.nearest, "ball");
}

TEST(PlanCheck, TellsStepsLimitsCablesAndTheTip) {
  const RobotParams table = zhu2022::table();
  ThetaVector a{}, b{};
  b[2] = 21.0 * kDegree;
  b[5] = -4.0 * kDegree;
  const PlanCheck found = check_plan(robot_of(table), config::SceneConfig{}, {a, b}, plain_tip(table, a));
  EXPECT_NEAR(found.max_joint_deg, 21.0, 1e-9);
  EXPECT_NEAR(found.over_limit_deg, 1.0, 1e-9);
  EXPECT_NEAR(found.max_step_deg, 21.0, 1e-9);
  EXPECT_EQ(found.min_clearance_m, kNothingNear_m);
  const CableLayout layout = cable_layout(table);
  const auto length_m = [&](const ThetaVector& theta) {
    return cable_geometry(table, layout, arm_trig(table, theta)).length_m;
  };
  EXPECT_NEAR(found.max_cable_step_m, zhu2022::largest_difference(length_m(a), length_m(b)), 1e-12);
  EXPECT_NEAR(found.duration_s, std::max(10.5, found.max_cable_step_m / 0.010), 1e-9);
  const Vec3 tip = forward_kinematics(table, b).tip_in_base.position_m;
  EXPECT_NEAR(found.tip_error_m, norm(subtract(tip, {4.0, 0.0, 0.0})), 1e-9);
  EXPECT_GT(found.tip_attitude_error_rad, 1.0);
  EXPECT_LT(check_plan(robot_of(table), config::SceneConfig{}, {a, b}, plain_tip(table, b)).tip_attitude_error_rad,
            1e-12);
}

}  // namespace
}  // namespace liana::planner
