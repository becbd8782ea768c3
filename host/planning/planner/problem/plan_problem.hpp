// The trajectory problem as numbers: variables, bounds, objective, constraints, exact derivatives, sparse structure.
// Knows no solver.
//
// Variables: the thetas of every waypoint that are free there. The first waypoint is fixed; the last one too when the
// goal is joint angles. Objective: (N - 1) / 2 sum |theta_(w+1) - theta_w|^2 [rad^2] + sum_j weight_j mean_w |node_j(w)
// - target_j| [m], N waypoints, the mean over all but the first, distances rounded to sqrt(d^2 + kRound_m^2) - kRound_m
// so that they are smooth. Constraints (rows), of which a problem holds those that matter near its path; they are
// chosen at setup and the structure then is fixed:
// - tip: position and the vector part of conj(q_goal) q_tip, 6 equalities at the last waypoint
// - clearance: a point of a link's axis against one obstacle, or against a plane that has the whole obstacle behind it,
// at a waypoint or at
//   a fixed share between two. Both ends of a link before a plane keep the whole link clear, and a plane has no edges
//   and no far side: that is how boxes are kept off (plan_rows.hpp)
// - step: change of a theta between two waypoints
// - cable: change of a cable's length between two waypoints
// - tension: of a cable at the motor at a waypoint, as the core plans it [kN, so that all rows are of one size]
#pragma once

#include <cstdint>
#include <vector>

#include "host/planning/planner/plan.hpp"
#include "host/planning/planner/problem/arm_derivatives.hpp"
#include "host/planning/planner/problem/planned_tension.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

constexpr double kRound_m = 0.01;
constexpr double kInnerTension_N = 0.01;  // what tension rows keep from floor and ceiling

// The pose at `share` (0 < share <= 1) of the way from waypoint `interval` to the next.
struct PathPlace {
  std::int32_t interval = 0;
  double share = 1.0;
  bool operator==(const PathPlace&) const = default;
};

// Points p with normal . p >= offset_m are on the arm's side; normal has unit length.
struct Plane {
  Vec3 normal{};
  double offset_m = 0.0;
};

struct ClearanceRow {
  PathPlace place;
  ArmPoint where;
  std::int32_t obstacle = 0;   // clearance.hpp
  std::optional<Plane> plane;  // stands for the obstacle
};
struct StepRow {
  std::int32_t interval = 0;
  std::int32_t theta = 0;
};
struct CableRow {
  std::int32_t interval = 0;
  std::int32_t cable = 0;
};
struct TensionRow {
  std::int32_t waypoint = 0;
  std::int32_t cable = 0;
};
struct PlanRows {
  std::vector<ClearanceRow> clearance;
  std::vector<StepRow> step;
  std::vector<CableRow> cable;
  std::vector<TensionRow> tension;  // in order of waypoints
};

// One entry of a sparse matrix.
struct Entry {
  std::int32_t row = 0;
  std::int32_t column = 0;
};

// Theta at a place of a path [rad].
ThetaVector theta_at(const Path& path, const PathPlace& place);

// True where theta k is not free at waypoint w of a path as long as the request says.
bool is_held(const HeldPhase& phase, std::int32_t waypoint, std::int32_t waypoints);

// Thetas that move a link: how many there are up to its own segment.
std::size_t thetas_before(const RobotParams& table, std::int32_t link);

class PlanProblem {
 public:
  // `path` has as many waypoints as the problem; its values are the start and those of everything fixed. Clearance rows
  // keep `clearance_m` from the link's surface; no theta leaves the path by more than `stride_rad`. The request must
  // outlive the problem.
  PlanProblem(const PlanRequest& request, const Path& path, const PlanRows& rows, double clearance_m,
              double stride_rad);

  std::int32_t variables() const { return static_cast<std::int32_t>(start_.size()); }
  std::int32_t constraints() const { return static_cast<std::int32_t>(constraint_lower_.size()); }
  const std::vector<double>& start() const { return start_; }
  const std::vector<double>& lower() const { return lower_; }
  const std::vector<double>& upper() const { return upper_; }
  const std::vector<double>& constraint_lower() const { return constraint_lower_; }
  const std::vector<double>& constraint_upper() const { return constraint_upper_; }
  // What constraint `row` is: tip, clearance, step, cable or tension.
  const char* constraint_kind(std::int32_t row) const;

  // The path of variables x.
  Path path_of(const double* x) const;

  double objective(const double* x);
  void gradient(const double* x, double* out);
  void constraint_values(const double* x, double* out);
  const std::vector<Entry>& jacobian_structure() const { return jacobian_; }
  void jacobian(const double* x, double* out);
  // Lower triangle of objective_factor H(objective) + sum multiplier_i H(constraint_i).
  const std::vector<Entry>& hessian_structure() const { return hessian_; }
  void hessian(const double* x, double objective_factor, const double* multipliers, double* out);

 private:
  using Index = std::size_t;
  using ThetaIndex = std::array<std::int32_t, kMaxTheta>;
  using ThetaBlock = std::array<ThetaIndex, kMaxTheta>;

  void number_variables();
  void build_bounds(double clearance_m);
  void build_jacobian();
  void build_hessian();
  std::int32_t add_hessian_entry(std::int32_t a, std::int32_t b);
  void add_jacobian_row(std::int32_t row, Index waypoint, Index thetas);
  void evaluate(const double* x);
  // Adds a symmetric matrix of thetas at a place to the Hessian's values.
  void scatter(const PathPlace& place, const ThetaHessian& block, double* out) const;
  void add_control_points(double factor, double* out) const;
  void add_tip_hessian(const double* multipliers, ThetaHessian& block) const;
  void add_cable_hessian(const CableRow& row, double multiplier, double* out) const;
  void add_tension_hessians(const double* multipliers, double* out) const;
  bool has_tip() const { return request_.tip_in_base.has_value(); }
  Index thetas() const { return static_cast<Index>(request_.robot.table.theta_count()); }
  Index last() const { return base_.size() - 1; }

  const PlanRequest& request_;
  double stride_rad_;
  Path base_;
  PlannedTension tension_;
  PlanRows rows_;                     // clearance rows in order of their places
  std::vector<PathPlace> places_;     // different places of the clearance rows
  std::vector<Index> place_of_row_;   // per clearance row
  std::vector<ThetaIndex> variable_;  // [waypoint][theta], -1 where fixed
  std::vector<double> start_, lower_, upper_, constraint_lower_, constraint_upper_;
  std::vector<Entry> jacobian_, hessian_;
  std::vector<ThetaBlock> own_block_;   // [waypoint][k][j], j <= k: position in the Hessian
  std::vector<ThetaBlock> next_block_;  // [waypoint][k][j]: theta k of the next waypoint with theta j of this one
  Index first_clearance_ = 0, first_step_ = 0, first_cable_ = 0, first_tension_ = 0;

  // At evaluated_x_.
  std::vector<double> evaluated_x_;
  Path path_;
  std::vector<ArmDerivatives> at_waypoint_;
  std::vector<ArmDerivatives> at_place_;
  std::vector<CableDerivatives> cables_;  // per waypoint; empty without cable rows
};

}  // namespace liana::planner
