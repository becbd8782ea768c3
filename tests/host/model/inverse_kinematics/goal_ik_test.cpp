// Goal IK: success rate, honesty, held variables, nodes, repeatability.
#include "host/model/inverse_kinematics/goal_ik.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware_like/pose_of_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using namespace inverse_kinematics;

using zhu2022::kX4AndX5;
using zhu2022::kX5;
using zhu2022::Random;

// Whatever it says, the angles must keep limits and held values, and "converged" must be true.
void expect_honest(const RobotParams& robot, const GoalIkProblem& problem, const GoalIkResult& result) {
  const double error = error_of(robot, problem.tip_in_base, result.theta_rad);
  ASSERT_TRUE(!result.converged || error <= 1e-6) << error;
  ASSERT_NEAR(std::hypot(result.position_error_m, result.attitude_error_rad), error, 1e-9);
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
    ASSERT_LE(std::fabs(result.theta_rad[k]), robot.segment[k / 2].theta_limit_rad) << k;
    ASSERT_TRUE(((problem.held_mask >> k) & 1u) == 0 || result.theta_rad[k] == problem.held_rad[k]) << k;
  }
}

// A goal that some pose within +-15 deg with the same held angles has.
GoalIkProblem random_goal(const RobotParams& robot, Random& random, std::uint32_t held, bool from_nearby) {
  GoalIkProblem problem;
  ThetaVector solution = random.theta(robot, 15.0);
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
    if (((held >> k) & 1u) != 0) solution[k] = 0.0;
  }
  problem.tip_in_base = forward_kinematics(robot, solution).tip_in_base;
  problem.held_mask = held;
  if (from_nearby) problem.from_rad = zhu2022::plus(solution, random.theta(robot, 3.0));
  return problem;
}

// 20,000 of each by tests/numbers/planning_goals.cpp.
// req:A38
TEST(GoalIk, FindsRandomGoalsWithTenNineAndEightVariables) {
  constexpr std::int32_t kGoals = 300;
  const RobotParams robot = zhu2022::table();
  for (const std::uint32_t held : {0u, kX5, kX4AndX5}) {
    for (const bool from_nearby : {false, true}) {
      Random random(1);
      std::int32_t converged = 0;
      std::vector<std::int32_t> iterations;
      for (std::int32_t i = 0; i < kGoals; ++i) {
        const GoalIkProblem problem = random_goal(robot, random, held, from_nearby);
        const GoalIkResult result = solve_goal(robot, problem);
        expect_honest(robot, problem, result);
        if (HasFatalFailure()) return;
        converged += result.converged ? 1 : 0;
        iterations.push_back(result.iterations);
      }
      EXPECT_GE(converged, kGoals - 1) << held << " " << from_nearby;
      std::sort(iterations.begin(), iterations.end());
      EXPECT_LE(iterations[kGoals * 99 / 100], 100) << held << " " << from_nearby;  // measured: 26 to 50
    }
  }
}

// Singular targets: convergence is slow there, and no restart would help.
TEST(GoalIk, FindsStraightNearlyStraightAndFullyBentArms) {
  const RobotParams robot = zhu2022::table();
  Random random(4);
  for (const double bend_deg : {0.0, 1e-4, 0.1, 1.0, 20.0}) {
    for (std::int32_t i = 0; i < 30; ++i) {
      ThetaVector solution = random.theta(robot, bend_deg);
      if (bend_deg == 20.0) {
        for (std::size_t k = 0; k < zhu2022::kThetas; ++k)
          solution[k] = solution[k] > 0.0 ? 20.0 * kDegree : -20.0 * kDegree;
      }
      GoalIkProblem problem;
      problem.tip_in_base = forward_kinematics(robot, solution).tip_in_base;
      problem.from_rad = random.theta(robot, 15.0);
      const GoalIkResult result = solve_goal(robot, problem);
      expect_honest(robot, problem, result);
      EXPECT_TRUE(result.converged) << bend_deg << " " << i;
    }
  }
}

TEST(GoalIk, UnreachableGoalsAreSaidToBeUnreachable) {
  const RobotParams robot = zhu2022::table();
  for (const Vec3& far : {Vec3{4.5, 0, 0}, Vec3{0, 6, 0}, Vec3{0, 0, -1e3}}) {
    GoalIkProblem problem;
    problem.tip_in_base.position_m = far;
    const GoalIkResult result = solve_goal(robot, problem);
    EXPECT_FALSE(result.converged);
    EXPECT_GT(result.position_error_m, 0.1);
    EXPECT_LE(result.iterations, kGoalAttempts * kGoalMostIterations);
    expect_honest(robot, problem, result);
  }
}

// req:A41
TEST(GoalIk, HeldAnglesMayHaveAnyValueAndKeepIt) {
  const RobotParams robot = zhu2022::table();
  GoalIkProblem problem;
  ThetaVector solution = zhu2022::radians(zhu2022::kPressRod_deg);
  solution[8] = problem.held_rad[8] = 0.7 * kDegree;
  problem.held_mask = kX5;
  problem.tip_in_base = forward_kinematics(robot, solution).tip_in_base;
  const GoalIkResult result = solve_goal(robot, problem);
  EXPECT_TRUE(result.converged);
  expect_honest(robot, problem, result);
}

// When the targets can all be met, they are.
// req:A44
TEST(GoalIk, MeetsNodeTargetsThatTheGoalsOwnShapeHas) {
  const RobotParams robot = zhu2022::table();
  Random random(2);
  double worst_m = 0.0;
  for (std::int32_t i = 0; i < 10; ++i) {
    const ThetaVector solution = random.theta(robot, 10.0);
    const ArmKinematics arm = forward_kinematics(robot, solution);
    GoalIkProblem problem;
    problem.tip_in_base = arm.tip_in_base;
    problem.from_rad = zhu2022::plus(solution, random.theta(robot, 1.0));
    GoalIkResult without = solve_goal(robot, problem);
    problem.node[0] = {3, arm.node_in_base[3].position_m, 1.0, 0.0};
    const GoalIkResult result = solve_goal(robot, problem);
    expect_honest(robot, problem, result);
    EXPECT_TRUE(result.converged);
    const Vec3 node = forward_kinematics(robot, result.theta_rad).node_in_base[3].position_m;
    EXPECT_NEAR(result.node_distance_m[0], norm(subtract(node, problem.node[0].position_m)), 1e-12);
    const Vec3 before = forward_kinematics(robot, without.theta_rad).node_in_base[3].position_m;
    EXPECT_LT(result.node_distance_m[0], norm(subtract(before, problem.node[0].position_m)));
    worst_m = std::max(worst_m, result.node_distance_m[0]);
  }
  EXPECT_LT(worst_m, 0.002);
}

TEST(GoalIk, ANodeIsBroughtWithinItsThresholdAndHardlyFarther) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector start = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const ArmKinematics arm = forward_kinematics(robot, start);
  ShapeProblem problem{{arm.tip_in_base, 0}, {}, {}};
  problem.node[0] = {3, add(arm.node_in_base[3].position_m, {0.0, 0.05, 0.1}), 1.0, 0.03};
  ThetaVector theta = start;
  std::int32_t iterations = 0;
  EXPECT_LT(improve_shape(robot, problem, theta, iterations), 1e-4);
  const Vec3 node = forward_kinematics(robot, theta).node_in_base[3].position_m;
  EXPECT_LE(norm(subtract(problem.node[0].position_m, node)), 0.0301);
  EXPECT_GE(norm(subtract(problem.node[0].position_m, node)), 0.02);
  EXPECT_TRUE(tip_error(problem.goal.tip_in_base, forward_kinematics(robot, theta).tip_in_base).converged());
}

TEST(GoalIk, TheReachOfANodeIsWhatItsTargetAloneWouldBring) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const ArmKinematics arm = forward_kinematics(robot, theta);
  const IkGoal goal{arm.tip_in_base, 0};
  const Vec3 third = arm.node_in_base[3].position_m;
  const NodeReach near = node_reach(robot, goal, theta, 3, add(third, {0.0, 0.03, 0.04}));
  EXPECT_NEAR(near.now_m, 0.05, 1e-12);
  EXPECT_LT(near.least_m, 1e-3);
  // In a direction: never farther than the arm is long, and the tip itself cannot move at all.
  const NodeReach up = node_reach(robot, goal, theta, 3, add(third, {0.0, 0.0, 20.0}));
  EXPECT_GT(up.now_m - up.least_m, 0.05);
  EXPECT_LT(up.now_m - up.least_m, 2.0);
  const NodeReach tip = node_reach(robot, goal, theta, 5, add(arm.tip_in_base.position_m, {0.0, 0.0, 20.0}));
  EXPECT_NEAR(tip.now_m, tip.least_m, 1e-6);
  // Held thetas leave less.
  const NodeReach held = node_reach(robot, {arm.tip_in_base, kX4AndX5}, theta, 3, add(third, {0.0, 0.0, 20.0}));
  EXPECT_LT(held.now_m - held.least_m, up.now_m - up.least_m);
}

// req:A42
TEST(GoalIk, ReportsTheReachOfEveryControlPoint) {
  const RobotParams robot = zhu2022::table();
  GoalIkProblem problem;
  problem.from_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const ArmKinematics arm = forward_kinematics(robot, problem.from_rad);
  problem.tip_in_base = arm.tip_in_base;
  problem.node[0] = {3, add(arm.node_in_base[3].position_m, {0.0, 0.0, 0.2}), 1.0, 0.0};
  problem.node[1] = {2, add(arm.node_in_base[2].position_m, {0.0, 0.0, -0.2}), 1.0, 0.0};
  const GoalIkResult result = solve_goal(robot, problem);
  ASSERT_TRUE(result.converged);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(result.node_reach[i].now_m, 0.2, 1e-9) << i;
    EXPECT_LE(result.node_reach[i].least_m, result.node_distance_m[i]) << i;
  }
  EXPECT_LT(result.node_reach[0].least_m, 0.1);
  EXPECT_EQ(result.node_reach[2].now_m, 0.0);
}

TEST(GoalIk, TheSameQuestionHasTheSameAnswerToTheLastBit) {
  const RobotParams robot = zhu2022::table();
  Random random(3);
  for (std::int32_t i = 0; i < 10; ++i) {
    const GoalIkProblem problem = random_goal(robot, random, kX5, false);
    const GoalIkResult a = solve_goal(robot, problem), b = solve_goal(robot, problem);
    EXPECT_EQ(a.theta_rad, b.theta_rad);
    EXPECT_EQ(a.iterations, b.iterations);
  }
}

TEST(GoalIk, AGoalThatIsAlreadyMetTakesNoIteration) {
  const RobotParams robot = zhu2022::table();
  GoalIkProblem problem;
  problem.from_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  problem.tip_in_base = forward_kinematics(robot, problem.from_rad).tip_in_base;
  const GoalIkResult result = solve_goal(robot, problem);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.theta_rad, problem.from_rad);
}

}  // namespace
}  // namespace liana::cable
