// Following the leader: curves, the arm along them, through the slit. Judged by the independent check and by figures of
// the finished plan.
#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/planning/planner/check/path_search.hpp"
#include "host/planning/planner/follow/follow.hpp"
#include "host/planning/planner/plan.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/planning/planner/requests.hpp"
#include "tests/message.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

Vec3 tip_of(const PlanRequest& request, const ThetaVector& theta) {
  return forward_kinematics(request.robot.table, theta).tip_in_base.position_m;
}

// From the panel edge pose 1.2 m forwards through the open, gently bent.
PlanRequest request_along_a_bend(const config::SceneConfig& scene = {}) {
  PlanRequest request = request_between(zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg, scene);
  request.to_rad.reset();
  request.max_step_rad = kFollowMaxStep_rad;
  request.follow.emplace();
  request.follow->points_m = {
      tip_of(request, request.from_rad), {0.6, -0.15, 0.40}, {1.0, -0.05, 0.35}, {1.4, 0.0, 0.40}};
  return request;
}

TEST(Curve, GoesThroughItsPointsAndIsMeasuredByItsLength) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1.5, 0.8, 0}, {1.5, 0.8, 1}};
  const Curve curve(points);
  for (const Vec3& point : points) {
    EXPECT_LT(norm(subtract(curve.nearest(point, 0.0, curve.length_m()).position_m, point)), 1e-9);
  }
  double length_m = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const CurvePlace a = curve.at(curve.length_m() * i / 1000), b = curve.at(curve.length_m() * (i + 1) / 1000);
    length_m += norm(subtract(b.position_m, a.position_m));
    EXPECT_NEAR(norm(a.tangent), 1.0, 1e-12);
    EXPECT_GT(dot(a.tangent, b.tangent), 0.99);  // no corners
  }
  EXPECT_NEAR(length_m, curve.length_m(), 1e-3);
  EXPECT_GT(curve.length_m(), 1.0 + std::hypot(0.5, 0.8) + 1.0);
}

TEST(Curve, NearestLooksNoFartherThanAsked) {
  const Curve curve({{0, 0, 0}, {1, 0, 0}});
  EXPECT_NEAR(curve.nearest({0.7, 0.2, 0}, 0.0, 1.0).along_m, 0.7, 1e-12);
  EXPECT_NEAR(curve.nearest({0.7, 0.2, 0}, 0.0, 0.5).along_m, 0.5, 1e-12);
  EXPECT_EQ(curve.nearest({-1, 0, 0}, 0.0, 1.0).along_m, 0.0);
}

TEST(Follow, KeepsTheTipOnTheCurveAndTheBodyNearTheTipsPath) {
  const PlanRequest request = request_along_a_bend();
  const PlanResult result = plan(request, {});
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.constraint << ": " << result.reason;
  EXPECT_EQ(result.waypoints_rad.front(), request.from_rad);
  EXPECT_LT(result.checked->tip_error_m, 1e-6);
  EXPECT_EQ(result.checked->over_limit_deg, 0.0);
  EXPECT_LE(result.checked->max_step_deg * kDegree, request.max_step_rad * 1.000001);
  EXPECT_LE(result.follow->tip_off_m, kFollowTipOff_m * 1.000001);
  EXPECT_GT(result.follow->body_off_m, result.follow->mean_body_off_m);
  EXPECT_LT(result.follow->mean_body_off_m, 0.13);
}

PlanRequest request_straight_ahead(double length_m) {
  PlanRequest request = request_along_a_bend();
  const Pose tip = forward_kinematics(request.robot.table, request.from_rad).tip_in_base;
  request.follow->points_m = {tip.position_m, add(tip.position_m, rotate(tip.quaternion, {length_m, 0, 0}))};
  return request;
}

TEST(Follow, ACurveThatTurnsBackIsFollowedToItsTurningPoint) {
  PlanRequest request = request_straight_ahead(0.08);
  request.follow->points_m.push_back(add(
      request.follow->points_m[0], scale(subtract(request.follow->points_m[1], request.follow->points_m[0]), 0.125)));
  const PlanResult result = plan(request, {});
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.constraint << ": " << result.reason;
  double nearest_m = 1.0;
  for (const ThetaVector& theta : result.waypoints_rad)
    nearest_m =
        std::min(nearest_m, norm(subtract(plain_axis(request.robot.table, theta).back(), request.follow->points_m[1])));
  EXPECT_LT(nearest_m, 2.0 * kFollowTipOff_m);
}

// Greatest distance of a link end from where it was at the start.
double largest_motion_m(const RobotParams& table, const Path& path) {
  const auto start = plain_axis(table, path.front());
  double most_m = 0.0;
  for (const ThetaVector& theta : path) {
    const auto here = plain_axis(table, theta);
    for (Index i = 0; i < here.size(); ++i) most_m = std::max(most_m, norm(subtract(here[i], start[i])));
  }
  return most_m;
}

TEST(Follow, MovesTheArmAsFarAsTheTipAndNoFartherStraightAhead) {
  for (const double length_m : {0.001, 0.3}) {
    const PlanRequest request = request_straight_ahead(length_m);
    const PlanResult result = plan(request, {});
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.constraint << ": " << result.reason;
    EXPECT_LT(largest_motion_m(request.robot.table, result.waypoints_rad), 2.0 * length_m);
    EXPECT_LT(result.follow->body_off_m, length_m);
    EXPECT_LE(result.follow->tip_off_m, kFollowTipOff_m * 1.000001);
  }
}

TEST(Follow, ASwingOfTheArmBeforeTheCurveShowsInTheFigures) {
  const PlanRequest request = request_straight_ahead(0.001);
  ThetaVector swung = request.from_rad;
  swung[0] += 0.02;  // at eight joints
  const FollowStatistics figures =
      follow_figures(request.robot.table, {request.from_rad, swung}, Curve(request.follow->points_m));
  EXPECT_GT(figures.body_off_m, 0.1);
  EXPECT_GT(figures.worst_link, 0);
}

TEST(Follow, SweepsFarLessOfTheRoomThanAPlanThatOnlyHasToArrive) {
  PlanRequest request = request_along_a_bend();
  const PlanResult followed = plan(request, {});
  ASSERT_EQ(followed.outcome, PlanOutcome::solved) << followed.reason;
  const Curve curve(request.follow->points_m);
  request.follow.reset();
  request.to_rad = followed.waypoints_rad.back();
  request.max_step_rad = default_max_step_rad(request.robot.table, request.waypoints);
  const PlanResult arrived = plan(request, {});
  ASSERT_EQ(arrived.outcome, PlanOutcome::solved) << arrived.reason;
  const FollowStatistics figures = follow_figures(request.robot.table, arrived.waypoints_rad, curve);
  EXPECT_LT(followed.follow->mean_body_off_m, 0.8 * figures.mean_body_off_m);
}

TEST(Follow, GoesThroughTheSlitToThePressRod) {
  PlanRequest request = request_between(zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg, panel_slit());
  request.max_step_rad = kFollowMaxStep_rad;
  request.follow.emplace();
  const PlanResult result = plan(request, {});
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.constraint << ": " << result.reason;
  EXPECT_EQ(result.waypoints_rad.front(), request.from_rad);
  EXPECT_EQ(result.waypoints_rad.back(), *request.to_rad);
  EXPECT_GE(result.checked->min_clearance_m, request.margin_m);
  EXPECT_LE(result.follow->tip_off_m, kFollowTipOff_m * 1.000001);
  EXPECT_GT(result.follow->curve_length_m, 3.0);
}

TEST(Follow, TheWayBackOfASolvedPlanIsVerifiedWithIt) {
  PlanRequest request = request_between(zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg, panel_slit());
  const PlanResult result = plan(request, {});
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  Path back = result.waypoints_rad;
  std::reverse(back.begin(), back.end());
  const PlanCheck check =
      check_plan(request.robot, request.scene, back, plain_tip(request.robot.table, request.from_rad));
  EXPECT_NEAR(check.min_clearance_m, result.checked->min_clearance_m, kUnseen_m);
  EXPECT_EQ(check.max_step_deg, result.checked->max_step_deg);
  EXPECT_EQ(check.max_cable_step_m, result.checked->max_cable_step_m);
  EXPECT_EQ(check.max_tension_N, result.checked->max_tension_N);
  EXPECT_EQ(check.min_tension_N, result.checked->min_tension_N);
  EXPECT_NEAR(check.duration_s, result.checked->duration_s, 1e-9);
  EXPECT_EQ(check.tip_error_m, 0.0);
}

TEST(Follow, HeldAnglesKeepTheirValues) {
  PlanRequest request = request_along_a_bend();
  request.held = {{9, request.from_rad[9], 0.0}};
  const PlanResult result = plan(request, {});
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.constraint << ": " << result.reason;
  for (const ThetaVector& theta : result.waypoints_rad) EXPECT_EQ(theta[9], request.from_rad[9]);
}

TEST(Follow, NamesWhatIsWrongWithACurve) {
  PlanRequest away = request_along_a_bend();
  away.follow->points_m.front()[2] += 0.02;
  const PlanResult off = plan(away, {});
  EXPECT_EQ(off.outcome, PlanOutcome::infeasible);
  EXPECT_EQ(off.constraint, "curve");
  EXPECT_TRUE(names(off.reason, {"begins", "20.0 mm", "tip"}));
  PlanRequest far = request_along_a_bend();
  far.follow->points_m.push_back({4.5, 0.0, 0.4});
  const PlanResult out = plan(far, {});
  EXPECT_EQ(out.constraint, "curve");
  EXPECT_TRUE(names(out.reason, {"reach"}));
  PlanRequest endless = request_along_a_bend();
  for (int i = 0; i < 500; ++i) endless.follow->points_m.push_back({1.0, i % 2 == 0 ? 1.0 : -1.0, 0.0});
  const PlanResult wound = plan(endless, {});
  EXPECT_TRUE(names(wound.reason, {"8.0 m"}));
  PlanRequest blocked = request_along_a_bend();
  blocked.scene.spheres.push_back({"ball", {1.0, -0.05, 0.35}, 0.05});  // on the curve
  const PlanResult hit = plan(blocked, {});
  EXPECT_NE(hit.outcome, PlanOutcome::solved);
  EXPECT_NE(hit.reason.find("'ball'"), std::string::npos) << hit.constraint << hit.reason;
  PlanRequest outside = request_between(zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, panel_slit());
  outside.follow.emplace();
  EXPECT_EQ(plan(outside, {}).constraint, "goal");
}

TEST(Follow, RefusesAGoalBesideACurve) {
  PlanRequest request = request_along_a_bend();
  request.to_rad = request.from_rad;
  EXPECT_THROW(plan(request, {}), std::invalid_argument);
  request.to_rad.reset();
  request.follow->points_m.resize(1);
  EXPECT_THROW(plan(request, {}), std::invalid_argument);
}

}  // namespace
}  // namespace liana::planner
