// Whole plans: through the slit, past obstacles, and the ways in which there is none. Judged by the independent check.
#include "host/planning/planner/plan.hpp"

#include <cmath>

#include "host/model/clearance/clearance.hpp"
#include "host/model/config/convex_shape.hpp"
#include "host/planning/planner/problem/plan_problem.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/planning/planner/requests.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

void aim_at_tip(PlanRequest& request) {
  request.tip_in_base = forward_kinematics(request.robot.table, *request.to_rad).tip_in_base;
  request.to_rad.reset();
}

void expect_solved(const PlanRequest& request, const PlanResult& result) {
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.constraint << ": " << result.reason;
  EXPECT_EQ(result.waypoints_rad.size(), Index(request.waypoints));
  EXPECT_EQ(result.waypoints_rad.front(), request.from_rad);
  EXPECT_GE(result.checked->min_clearance_m, request.margin_m);
  EXPECT_LE(result.checked->max_step_deg * kDegree, request.max_step_rad * 1.000001);
  EXPECT_EQ(result.checked->over_limit_deg, 0.0);
  EXPECT_LT(result.checked->tip_error_m, 1e-6);
  EXPECT_TRUE(result.settled);
}

// req:A47
TEST(Plan, GoesThroughTheSlitToThePressRod) {
  const PlanRequest request = request_between(zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg, panel_slit());
  const PlanResult result = plan(request, {});
  expect_solved(request, result);
  EXPECT_EQ(result.waypoints_rad.back(), *request.to_rad);
  EXPECT_LT(result.iterations, 300);
}

TEST(Plan, FindsTheAnglesForATipInTheSlitItself) {
  PlanRequest request = request_between(zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg, panel_slit());
  aim_at_tip(request);
  expect_solved(request, plan(request, {}));
}

TEST(Plan, KeepsHeldAnglesAndPlanarPhases) {
  PlanRequest request = request_between(zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg, panel_slit());
  aim_at_tip(request);
  request.held = {{8, 0.0, 0.4}, {6, 0.0, 0.7}};
  const PlanResult result = plan(request, {});
  expect_solved(request, result);
  for (Index w = 8; w < 20; ++w) EXPECT_EQ(result.waypoints_rad[w][8], 0.0) << w;   // 0.4 of 19 intervals
  for (Index w = 14; w < 20; ++w) EXPECT_EQ(result.waypoints_rad[w][6], 0.0) << w;  // 0.7
}

// The straight way is blocked by a ball in its middle.
PlanRequest request_past_a_ball() {
  const zhu2022::Degrees from{0, -5, 0, -5, 0, -5, 0, 0, 0, 0}, to{0, 5, 0, 5, 0, 5, 0, 0, 0, 0};
  config::SceneConfig scene;
  scene.spheres.push_back({"ball", {2.5, 0.0, 0.1}, 0.2});
  return request_between(from, to, scene);
}

TEST(Plan, GoesRoundABallInTheMiddleOfTheStraightWay) {
  const PlanRequest request = request_past_a_ball();
  const PlanResult result = plan(request, {});
  expect_solved(request, result);
  EXPECT_LT(result.checked->min_clearance_m, 0.05);  // no larger detour than needed
}

TEST(Plan, GoesRoundConvexBodiesAsTheCheckWithLibccdConfirms) {
  const config::SceneConvex tank = config::cylinder("tank", {2.5, 0.0, -0.1}, {2.5, 0.0, 0.3}, 0.15);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 2.4 : 2.6, i & 2 ? 0.14 : -0.14, i & 4 ? 0.25 : -0.05});
  for (const config::SceneConvex& body : {tank, config::hull_of("block", corners)}) {
    PlanRequest request = request_past_a_ball();
    request.scene = {};
    request.scene.convex.push_back(body);
    const PlanResult result = plan(request, {});
    expect_solved(request, result);
    EXPECT_LT(result.checked->min_clearance_m, 0.05) << body.name;
    EXPECT_EQ(result.checked->nearest, body.name);
  }
}

// req:A42 req:A44
TEST(Plan, BringsAControlPointNearerForItsWeight) {
  PlanRequest request = request_past_a_ball();
  request.waypoints = 12;
  request.max_step_rad = 10.0 * kDegree;
  const Vec3 target{1.4, -0.2, 0.8};
  const auto mean_distance_m = [&](const PlanResult& result) {
    double sum = 0.0;
    for (const ThetaVector& theta : result.waypoints_rad) {
      sum += norm(subtract(forward_kinematics(request.robot.table, theta).node_in_base[2].position_m, target));
    }
    return sum / static_cast<double>(result.waypoints_rad.size());
  };
  const PlanResult without = plan(request, {});
  request.control_points = {{2, target, 0.5}};
  const PlanResult with = plan(request, {});
  ASSERT_EQ(with.outcome, PlanOutcome::solved) << with.reason;
  EXPECT_LT(mean_distance_m(with), 0.7 * mean_distance_m(without));
}

// req:A43
TEST(Plan, OfASinglePoseKeepsTheTipAndComesNearerToTheControlPoint) {
  PlanRequest request = request_between(zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, config::SceneConfig{});
  aim_at_tip(request);
  request.waypoints = 1;
  const PlanResult plain = plan(request, {});
  ASSERT_EQ(plain.outcome, PlanOutcome::solved) << plain.reason;
  ASSERT_EQ(plain.waypoints_rad.size(), 1u);
  const auto node_3 = [&](const PlanResult& result) {
    return forward_kinematics(request.robot.table, result.waypoints_rad.back()).node_in_base[3].position_m;
  };
  const Vec3 target = add(node_3(plain), {0.05, 0.05, 0.05});
  request.control_points = {{3, target, 10.0}};
  const PlanResult pulled = plan(request, {});
  ASSERT_EQ(pulled.outcome, PlanOutcome::solved) << pulled.reason;
  EXPECT_LT(norm(subtract(node_3(pulled), target)), 0.8 * norm(subtract(node_3(plain), target)));
  EXPECT_LT(pulled.checked->tip_error_m, 1e-6);
}

TEST(Plan, IsTheSameForTheSameRequest) {
  const PlanRequest request = request_past_a_ball();
  const PlanResult a = plan(request, {}), b = plan(request, {});
  EXPECT_EQ(a.waypoints_rad, b.waypoints_rad);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(plan_hash(request, a), plan_hash(request, b));
}

TEST(Plan, HashChangesWithEveryInputAndWithTheResult) {
  const PlanRequest request = request_past_a_ball();
  PlanResult result;
  result.outcome = PlanOutcome::solved;
  result.waypoints_rad = {request.from_rad, *request.to_rad};
  const std::string hash = plan_hash(request, result);
  EXPECT_EQ(hash.size(), 64u);
  PlanResult other = result;
  other.waypoints_rad[1][0] += 1e-15;
  EXPECT_NE(plan_hash(request, other), hash);
  const auto changed = [&](const auto& change) {
    PlanRequest copy = request;
    change(copy);
    return plan_hash(copy, result) != hash;
  };
  EXPECT_TRUE(changed([](PlanRequest& r) { r.margin_m += 1e-9; }));
  EXPECT_TRUE(changed([](PlanRequest& r) { r.held.push_back({1, 0.0, 0.0}); }));
  EXPECT_TRUE(changed([](PlanRequest& r) { r.control_points.push_back({1, {1, 0, 0}, 1.0}); }));
  EXPECT_TRUE(changed([](PlanRequest& r) { r.scene.canonical_json = "other"; }));
  EXPECT_TRUE(changed([](PlanRequest& r) { r.from_rad[9] += 1e-9; }));
}

TEST(Plan, NamesBodyLinkAndDepthWhenTheStartOrTheGoalCollides) {
  PlanRequest request = request_past_a_ball();
  request.scene.spheres[0].center_m = link_points(request.robot.table, *request.to_rad).point_in_base[30];
  const PlanResult goal = plan(request, {});
  EXPECT_EQ(goal.outcome, PlanOutcome::infeasible);
  EXPECT_EQ(goal.constraint, "goal");
  EXPECT_NE(goal.reason.find("mm inside 'ball'"), std::string::npos) << goal.reason;
  EXPECT_NE(goal.reason.find("link 30"), std::string::npos) << goal.reason;
  EXPECT_TRUE(goal.waypoints_rad.empty());
  std::swap(request.from_rad, *request.to_rad);
  EXPECT_EQ(plan(request, {}).constraint, "start");
}

TEST(Plan, NamesTheConstraintThatCannotBeMet) {
  PlanRequest steps = request_past_a_ball();
  steps.max_step_rad = 0.2 * kDegree;  // 10 deg to go in 19 steps
  EXPECT_EQ(plan(steps, {}).constraint, "step");
  PlanRequest far = request_past_a_ball();
  far.to_rad.reset();
  far.tip_in_base = Pose{{5.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  const PlanResult unreachable = plan(far, {});
  EXPECT_EQ(unreachable.outcome, PlanOutcome::infeasible);
  EXPECT_EQ(unreachable.constraint, "tip");
}

TEST(Plan, KeepsCablesUnderTheCeilingWhereTheShortestWayDoesNot) {
  const zhu2022::Degrees from{5, 5, 0, -8, 1, 7, 4, 8, 6, 10}, to{-12, 13, 5, 3, 4, 1, -4, -3, -8, -11};
  PlanRequest request = request_between(from, to, config::SceneConfig{});
  aim_at_tip(request);
  const PlanResult shortest = plan(request, {});
  ASSERT_EQ(shortest.outcome, PlanOutcome::solved) << shortest.reason;
  request.robot.table.tension.ceiling_free_N = 70.0;
  const PlannedTension tension(request.robot.table);
  double excess_N = 0.0;
  for (const ThetaVector& theta : shortest.waypoints_rad) excess_N = std::max(excess_N, tension.excess_N(theta));
  ASSERT_GT(excess_N, 1.0);
  const PlanResult result = plan(request, {});
  expect_solved(request, result);
  EXPECT_LE(result.checked->max_tension_N, 70.0);
  EXPECT_GT(result.checked->max_tension_N, 69.0);  // no farther than needed
}

TEST(Plan, NamesTheTensionOfAnEndThatTheCablesCannotHold) {
  PlanRequest request = request_past_a_ball();
  request.robot.table.tension.ceiling_free_N = 30.0;  // less than every pose is held with
  const PlanResult result = plan(request, {});
  EXPECT_EQ(result.outcome, PlanOutcome::infeasible);
  EXPECT_EQ(result.constraint, "tension");
  EXPECT_NE(result.reason.find("at the start"), std::string::npos) << result.reason;
}

TEST(Plan, EndsAsCancelledWhenAskedTo) {
  const std::atomic<bool> cancelled = true;
  PlanControl control;
  control.cancelled = &cancelled;
  const PlanResult result = plan(request_past_a_ball(), control);
  EXPECT_EQ(result.outcome, PlanOutcome::cancelled);
  EXPECT_TRUE(result.waypoints_rad.empty());
}

TEST(Plan, RefusesSizesOutOfRange) {
  PlanRequest request = request_past_a_ball();
  request.waypoints = 101;
  EXPECT_THROW(plan(request, {}), std::invalid_argument);
  request.waypoints = 1;  // joint angles leave nothing to find
  EXPECT_THROW(plan(request, {}), std::invalid_argument);
}

}  // namespace
}  // namespace liana::planner
