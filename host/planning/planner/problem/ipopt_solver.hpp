// Ipopt behind one function: the only file that knows it is ipopt_solver.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "host/planning/planner/problem/plan_problem.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

enum class SolveStatus { solved, infeasible, limit, cancelled };

struct Solution {
  SolveStatus status = SolveStatus::limit;
  std::vector<double> x;  // the last point, whatever the status
  double objective = 0.0;
  std::int32_t iterations = 0;
  std::int32_t worst_constraint = -1;  // row that is violated most, -1 when all hold to kConstraintTolerance
  double worst_violation = 0.0;
};

// m, rad: within this every constraint of a solved problem holds.
constexpr double kConstraintTolerance = 1e-7;

// Solves from problem.start() within control.max_iterations; asks control.cancelled in every iteration.
Solution solve(PlanProblem& problem, const PlanControl& control);

}  // namespace liana::planner
