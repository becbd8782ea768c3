#include "host/planning/planner/problem/ipopt_solver.hpp"

#include <algorithm>
#include <cmath>
#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>
#include <cstdio>
#include <stdexcept>

namespace liana::planner {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr std::int32_t kProgressEvery = 10;  // iterations

// Hands every question of Ipopt on to the problem.
class Adapter : public Ipopt::TNLP {
 public:
  Adapter(PlanProblem& problem, const PlanControl& control) : problem_(problem), control_(control) {}

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = problem_.variables();
    m = problem_.constraints();
    jacobian = static_cast<Index>(problem_.jacobian_structure().size());
    hessian = static_cast<Index>(problem_.hessian_structure().size());
    style = TNLP::C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* x_low, Number* x_high, Index, Number* g_low, Number* g_high) override {
    std::copy(problem_.lower().begin(), problem_.lower().end(), x_low);
    std::copy(problem_.upper().begin(), problem_.upper().end(), x_high);
    std::copy(problem_.constraint_lower().begin(), problem_.constraint_lower().end(), g_low);
    std::copy(problem_.constraint_upper().begin(), problem_.constraint_upper().end(), g_high);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(problem_.start().begin(), problem_.start().end(), x);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = problem_.objective(x);
    return true;
  }

  bool eval_grad_f(Index, const Number* x, bool, Number* out) override {
    problem_.gradient(x, out);
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* out) override {
    problem_.constraint_values(x, out);
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* rows, Index* columns, Number* values) override {
    if (values == nullptr) return structure(problem_.jacobian_structure(), rows, columns);
    problem_.jacobian(x, values);
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number factor, Index, const Number* multipliers, bool, Index, Index* rows,
              Index* columns, Number* values) override {
    if (values == nullptr) return structure(problem_.hessian_structure(), rows, columns);
    problem_.hessian(x, factor, multipliers, values);
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number objective, Number infeasibility, Number,
                             Number, Number, Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    solution.iterations = iteration;
    if (control_.progress && iteration % kProgressEvery == 0) {
      char line[100];
      std::snprintf(line, sizeof line, "iteration %d: objective %.6g, violation %.1e", static_cast<int>(iteration),
                    objective, infeasibility);
      control_.progress(line);
    }
    return control_.cancelled == nullptr || !control_.cancelled->load();
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*, const Number*, Index m,
                         const Number* g, const Number*, Number objective, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    solution.x.assign(x, x + n);
    solution.objective = objective;
    for (Index row = 0; row < m; ++row) {
      const auto i = static_cast<std::size_t>(row);
      const double violation =
          std::max(problem_.constraint_lower()[i] - g[row], g[row] - problem_.constraint_upper()[i]);
      if (violation <= std::max(solution.worst_violation, kConstraintTolerance)) continue;
      solution.worst_violation = violation;
      solution.worst_constraint = row;
    }
  }

  Solution solution;

 private:
  static bool structure(const std::vector<Entry>& entries, Index* rows, Index* columns) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      rows[i] = entries[i].row;
      columns[i] = entries[i].column;
    }
    return true;
  }

  PlanProblem& problem_;
  const PlanControl& control_;
};

SolveStatus status_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Solved_To_Acceptable_Level:
      return SolveStatus::solved;
    case Ipopt::Infeasible_Problem_Detected:
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return SolveStatus::infeasible;
    case Ipopt::User_Requested_Stop:
      return SolveStatus::cancelled;
    default:
      return SolveStatus::limit;
  }
}

void set_options(Ipopt::OptionsList& options, std::int32_t max_iterations) {
  options.SetIntegerValue("print_level", 0);
  options.SetStringValue("sb", "yes");
  options.SetIntegerValue("max_iter", max_iterations);
  options.SetStringValue("linear_solver", "mumps");
  options.SetStringValue("nlp_scaling_method", "none");  // metres and radians are of one size here
  options.SetNumericValue("tol", 1e-5);
  options.SetNumericValue("constr_viol_tol", kConstraintTolerance);
  options.SetNumericValue("acceptable_tol", 1e-3);
  options.SetNumericValue("acceptable_constr_viol_tol", kConstraintTolerance);
  options.SetIntegerValue("acceptable_iter", 8);
  // The start is nearly the solution: stay near it.
  options.SetNumericValue("mu_init", 1e-4);
  options.SetNumericValue("bound_push", 1e-6);
  options.SetNumericValue("bound_frac", 1e-6);
}

}  // namespace

Solution solve(PlanProblem& problem, const PlanControl& control) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication(false);
  set_options(*ipopt->Options(), control.max_iterations);
  if (ipopt->Initialize() != Ipopt::Solve_Succeeded) throw std::runtime_error("Ipopt cannot be initialised");
  Ipopt::SmartPtr<Adapter> adapter = new Adapter(problem, control);
  const Ipopt::ApplicationReturnStatus status = ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(adapter)));
  adapter->solution.status = status_of(status);
  if (adapter->solution.x.empty()) adapter->solution.x = problem.start();
  return adapter->solution;
}

}  // namespace liana::planner
