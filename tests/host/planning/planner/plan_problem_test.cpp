// The planner's problem without a solver: structure, first and second derivatives against central differences.
#include "host/planning/planner/problem/plan_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kStep = 1e-6;
constexpr double kTensionStep = 1e-4;  // tension rows have derivatives by differences, which smaller steps would see

config::SceneConfig two_obstacles() {
  config::SceneConfig scene;
  scene.spheres.push_back({"ball", {1.0, 0.8, 0.4}, 0.2});
  const Quat q = quaternion_of({0.3, -0.5, 0.2});
  scene.boxes.push_back(
      {"box", {2.0, -1.0, 0.3}, {0.3, 0.1, 0.2}, {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1})}});
  return scene;
}

// Every kind of row and objective, a held theta and a planar phase, four waypoints.
PlanRequest request_with_all() {
  PlanRequest request;
  request.robot.table = zhu2022::table();
  request.robot.module_radius_m = 0.03;
  request.scene = two_obstacles();
  request.tip_in_base = Pose{{2.0, 1.0, 0.5}, quaternion_of({0.1, 0.4, -0.8})};
  request.held = {{3, 0.02, 0.0}, {8, 0.0, 0.6}};
  request.control_points = {{3, {1.5, 0.5, 0.5}, 0.7}, {1, {0.7, 0.1, 0.2}, 0.3}};
  request.waypoints = 4;
  request.max_step_rad = 0.1;
  return request;
}

Path random_path(zhu2022::Random& random, const PlanRequest& request) {
  Path path;
  for (std::int32_t w = 0; w < request.waypoints; ++w) {
    path.push_back(random.theta(request.robot.table, 10.0));
    for (const HeldPhase& phase : request.held) {
      if (is_held(phase, w, request.waypoints)) path.back()[Index(phase.theta)] = phase.value_rad;
    }
  }
  return path;
}

PlanRows rows_of_all_kinds() {
  PlanRows rows;
  const Plane plane{{0.6, 0.0, -0.8}, 0.1};
  rows.clearance = {{{2, 1.0}, {39, 0.4}, 0, {}},
                    {{1, 0.25}, {20, 1.0}, 1, {}},
                    {{0, 0.5}, {33, 0.0}, 0, {}},
                    {{1, 0.25}, {9, 0.7}, 0, plane},
                    {{1, 1.0}, {25, 0.5}, 1, plane}};
  rows.step = {{0, 0}, {1, 7}, {2, 8}};
  rows.cable = {{0, 2}, {1, 14}, {2, 6}};
  rows.tension = {{1, 0}, {1, 13}, {3, 7}};
  return rows;
}

struct Case {
  PlanRequest request = request_with_all();
  Path path;
  std::vector<double> multipliers;
  explicit Case(std::uint64_t seed) {
    zhu2022::Random random(seed);
    path = random_path(random, request);
    for (int i = 0; i < 20; ++i) multipliers.push_back(random.uniform(-1.0, 1.0));
  }
};

std::vector<double> gradient_of(PlanProblem& problem, const std::vector<double>& x) {
  std::vector<double> out(x.size());
  problem.gradient(x.data(), out.data());
  return out;
}

std::vector<double> values_of(PlanProblem& problem, const std::vector<double>& x) {
  std::vector<double> out(Index(problem.constraints()));
  problem.constraint_values(x.data(), out.data());
  return out;
}

// Dense, rows x variables.
std::vector<std::vector<double>> jacobian_of(PlanProblem& problem, const std::vector<double>& x) {
  std::vector<double> values(problem.jacobian_structure().size());
  problem.jacobian(x.data(), values.data());
  std::vector<std::vector<double>> out(Index(problem.constraints()), std::vector<double>(x.size(), 0.0));
  for (Index i = 0; i < values.size(); ++i) {
    out[Index(problem.jacobian_structure()[i].row)][Index(problem.jacobian_structure()[i].column)] += values[i];
  }
  return out;
}

// Gradient of factor f + sum multiplier_i g_i.
std::vector<double> lagrangian_gradient(PlanProblem& problem, const std::vector<double>& x, double factor,
                                        const std::vector<double>& multipliers) {
  std::vector<double> out = gradient_of(problem, x);
  const auto J = jacobian_of(problem, x);
  for (Index k = 0; k < out.size(); ++k) {
    out[k] *= factor;
    for (Index i = 0; i < J.size(); ++i) out[k] += multipliers[i] * J[i][k];
  }
  return out;
}

TEST(PlanProblem, GradientAndJacobianAreTheCentralDifferences) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Case made(seed);
    PlanProblem problem(made.request, made.path, rows_of_all_kinds(), 0.005, 1.0);
    std::vector<double> x = problem.start();
    const std::vector<double> gradient = gradient_of(problem, x);
    const auto J = jacobian_of(problem, x);
    for (Index k = 0; k < x.size(); ++k) {
      const double here = x[k];
      x[k] = here + kStep;
      const double f_after = problem.objective(x.data());
      const std::vector<double> g_after = values_of(problem, x);
      x[k] = here - kStep;
      const double f_before = problem.objective(x.data());
      const std::vector<double> g_before = values_of(problem, x);
      x[k] = here;
      EXPECT_NEAR(gradient[k], (f_after - f_before) / (2.0 * kStep), 1e-7);
      for (Index i = 0; i < J.size(); ++i)
        EXPECT_NEAR(J[i][k], (g_after[i] - g_before[i]) / (2.0 * kStep), 1e-6) << problem.constraint_kind(int(i));
    }
  }
}

TEST(PlanProblem, HessianIsTheCentralDifferenceOfTheLagrangiansGradient) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Case made(seed);
    PlanProblem problem(made.request, made.path, rows_of_all_kinds(), 0.005, 1.0);
    ASSERT_EQ(problem.constraints(), std::int32_t(made.multipliers.size()));
    for (Index i = 0; i < made.multipliers.size(); ++i) {  // tension has a test of its own
      if (std::string(problem.constraint_kind(int(i))) == "tension") made.multipliers[i] = 0.0;
    }
    std::vector<double> x = problem.start();
    std::vector<double> values(problem.hessian_structure().size());
    problem.hessian(x.data(), 0.6, made.multipliers.data(), values.data());
    std::vector<std::vector<double>> H(x.size(), std::vector<double>(x.size(), 0.0));
    for (Index i = 0; i < values.size(); ++i) {
      ASSERT_GE(problem.hessian_structure()[i].row, problem.hessian_structure()[i].column);
      H[Index(problem.hessian_structure()[i].row)][Index(problem.hessian_structure()[i].column)] += values[i];
    }
    for (Index k = 0; k < x.size(); ++k) {
      const double here = x[k];
      x[k] = here + kStep;
      const std::vector<double> after = lagrangian_gradient(problem, x, 0.6, made.multipliers);
      x[k] = here - kStep;
      const std::vector<double> before = lagrangian_gradient(problem, x, 0.6, made.multipliers);
      x[k] = here;
      for (Index j = 0; j < x.size(); ++j)
        EXPECT_NEAR(H[std::max(k, j)][std::min(k, j)], (after[j] - before[j]) / (2.0 * kStep), 1e-5);
    }
  }
}

TEST(PlanProblem, HessianOfTensionRowsIsTheCentralDifferenceOfTheirJacobian) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Case made(seed);
    PlanRows rows;
    rows.tension = rows_of_all_kinds().tension;
    made.request.tip_in_base.reset();
    made.request.to_rad = made.path.back();
    rows.tension.pop_back();  // at the last waypoint
    made.request.control_points.clear();
    PlanProblem problem(made.request, made.path, rows, 0.005, 1.0);
    const std::vector<double> multipliers{0.7, -0.4};
    std::vector<double> x = problem.start();
    std::vector<double> values(problem.hessian_structure().size());
    problem.hessian(x.data(), 0.0, multipliers.data(), values.data());
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::fabs(value));
    ASSERT_GT(largest, 0.0);
    for (Index i = 0; i < values.size(); ++i) {
      const Index k = Index(problem.hessian_structure()[i].row), j = Index(problem.hessian_structure()[i].column);
      const double here = x[k];
      x[k] = here + kTensionStep;
      const double after = lagrangian_gradient(problem, x, 0.0, multipliers)[j];
      x[k] = here - kTensionStep;
      const double before = lagrangian_gradient(problem, x, 0.0, multipliers)[j];
      x[k] = here;
      EXPECT_NEAR(values[i], (after - before) / (2.0 * kTensionStep), 1e-3 * largest);
    }
  }
}

TEST(PlanProblem, EntriesOfTheHessianAreDifferent) {
  const Case made(1);
  const PlanProblem problem(made.request, made.path, rows_of_all_kinds(), 0.005, 1.0);
  std::set<std::pair<int, int>> seen;
  for (const Entry& entry : problem.hessian_structure()) EXPECT_TRUE(seen.insert({entry.row, entry.column}).second);
}

TEST(PlanProblem, HeldThetasAndTheStartAreNoVariablesAndKeepTheirValues) {
  const Case made(2);
  const PlanProblem problem(made.request, made.path, rows_of_all_kinds(), 0.005, 1.0);
  EXPECT_EQ(problem.variables(),
            3 * 9 - 2);  // three waypoints without theta 4; theta 9 is held from waypoint 2 of 0..3 on
  std::vector<double> x(Index(problem.variables()), 0.1);
  const Path path = problem.path_of(x.data());
  EXPECT_EQ(path[0], made.path[0]);
  for (Index w = 1; w < 4; ++w) EXPECT_EQ(path[w][3], 0.02);
  EXPECT_EQ(path[1][8], 0.1);
  EXPECT_EQ(path[2][8], 0.0);
  EXPECT_EQ(path[3][8], 0.0);
}

TEST(PlanProblem, WithGoalAnglesTheLastWaypointIsNoVariableEither) {
  Case made(3);
  made.request.tip_in_base.reset();
  made.request.to_rad = made.path.back();
  const PlanProblem problem(made.request, made.path, {}, 0.005, 1.0);
  EXPECT_EQ(problem.variables(), 2 * 9 - 1);
  EXPECT_EQ(problem.constraints(), 0);
}

}  // namespace
}  // namespace liana::planner
