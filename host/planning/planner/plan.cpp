#include "host/planning/planner/plan.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/math/trig.hpp"
#include "host/planning/planner/follow/follow.hpp"
#include "host/planning/planner/plan_refusal.hpp"
#include "host/planning/planner/problem/ipopt_solver.hpp"
#include "host/planning/planner/problem/plan_rows.hpp"
#include "host/planning/planner/start/goal_poses.hpp"
#include "host/planning/planner/start/relax.hpp"
#include "host/planning/planner/start/start_path.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr std::int32_t kMaxRounds = 12;
constexpr double kStride_rad =
    0.05;  // of every theta in one round: planes made on a path are good near it, and Newton steps too
constexpr double kInner_m =
    0.001;  // the solver keeps this beyond the margin, so that what lies between rows keeps the margin
constexpr double kRecheck_m = 0.0003;     // rows are added where less than this beyond the margin is left
constexpr double kStartSpacing_m = 0.01;  // of motion between the poses looked at in a start path
constexpr double kSettled = 0.01;         // of the objective: what a last round gains at most
constexpr double kAnyStride_rad = 10.0;   // while the path is not free it has to go where it can become so
constexpr double kRoundOff = 1e-6;        // relative

void require(bool good, const char* message) {
  if (!good) throw std::invalid_argument(message);
}

void validate(const PlanRequest& request) {
  if (request.follow && !request.follow->points_m.empty()) {
    require(request.follow->points_m.size() >= 2 && request.follow->points_m.size() <= kMaxFollowPoints,
            "curve: allowed: 2 to 1000 points");
    require(!request.to_rad && !request.tip_in_base, "goal: a curve's end is the goal");
  } else {
    require(request.to_rad.has_value() != request.tip_in_base.has_value(), "goal: either joint angles or a tip pose");
  }
  require(request.waypoints >= 1 && request.waypoints <= kMaxWaypoints, "waypoints: allowed: 1 to 100");
  require(request.waypoints > 1 || request.tip_in_base,
          "waypoints: 1 is for a tip pose: joint angles leave nothing to find");
  require(request.margin_m >= 0.0 && request.margin_m <= 1.0, "margin: allowed: 0 to 1 m");
  require(request.max_step_rad > 0.0, "max step: allowed: over 0");
  require(request.control_points.size() <= kMaxControlPoints, "control points: at most 4");
}

// Where the arm is nearest, as one clause.
std::string nearest_text(const Room& room, double clearance_m, std::int32_t link, std::int32_t obstacle) {
  return text("link %d ", static_cast<int>(link) + 1) +
         distance_text(clearance_m, "'" + clearance::obstacle_name(room.scene(), obstacle) + "'");
}

class Planner {
 public:
  Planner(const PlanRequest& request, const PlanControl& control)
      : request_(request), control_(control), room_(request.robot, request.scene) {}

  PlanResult run() {
    if (!pose_is_good(request_.from_rad, "start")) return result_;
    if (request_.follow && !request_.follow->points_m.empty()) {
      if (is_short_enough(request_.follow->points_m)) follow(Curve(request_.follow->points_m), {});
      return result_;
    }
    const Path goals = goals_or_none();
    if (goals.empty()) return result_;
    for (const ThetaVector& goal : goals) {
      if (request_.follow ? through_slit(goal) : search(goal)) return result_;
    }
    if (result_.constraint.empty())
      fail(PlanOutcome::limit, "path",
           "no free way was found; try more waypoints, a smaller margin or a control point");
    return result_;
  }

 private:
  bool cancelled() const { return control_.cancelled != nullptr && control_.cancelled->load(); }
  void tell(const std::string& line) const {
    if (control_.progress) control_.progress(line);
  }

  bool fail(PlanOutcome outcome, const char* constraint, const std::string& reason) {
    result_.outcome = outcome;
    result_.constraint = constraint;
    result_.reason = reason;
    result_.waypoints_rad.clear();
    return false;
  }

  bool pose_is_good(const ThetaVector& theta, const char* which) {
    const clearance::ArmClearance here = room_.look(theta);
    if (here.nearest.distance_m < request_.margin_m) {
      return fail(PlanOutcome::infeasible, which,
                  text("at the %s %s; the margin is %.1f mm", which,
                       nearest_text(room_, here.nearest.distance_m, here.link, here.obstacle).c_str(),
                       1000.0 * request_.margin_m));
    }
    const SelfClearance self = self_clearance(request_.robot, theta);
    if (self.clearance_m < kSelfMargin_m) {
      return fail(
          PlanOutcome::infeasible, "self",
          text("at the %s %s; the margin is %.1f mm", which, nearest_text(self).c_str(), 1000.0 * kSelfMargin_m));
    }
    const double excess_N = PlannedTension(room_.table()).excess_N(theta);
    if (excess_N <= 0.0) return true;
    return fail(PlanOutcome::infeasible, "tension",
                text("at the %s a cable would be pulled %.1f N beyond the %.0f to %.0f N that are allowed", which,
                     excess_N, room_.table().tension.floor_motor_N, room_.table().tension.ceiling_free_N));
  }

  Path goals_or_none() {
    if (request_.to_rad) {
      if (!pose_is_good(*request_.to_rad, "goal") || (!request_.follow && !steps_suffice(*request_.to_rad))) return {};
      return {*request_.to_rad};
    }
    tell("looking for joint angles of the tip pose");
    const GoalPoses poses = goal_poses(room_, request_);
    if (!poses.reachable) {
      fail(PlanOutcome::infeasible, "tip", "no joint angles within the limits bring the tip there");
    } else if (poses.theta_rad.empty()) {
      pose_is_good(poses.nearest_rad, "goal");
    }
    return poses.theta_rad;
  }

  bool steps_suffice(const ThetaVector& goal) {
    for (Index k = 0; k < goal.size(); ++k) {
      const double way = std::fabs(goal[k] - request_.from_rad[k]),
                   most = request_.max_step_rad * (request_.waypoints - 1);
      if (way <= most * (1.0 + kRoundOff)) continue;
      return fail(PlanOutcome::infeasible, "step",
                  text("theta %d has %.2f deg to go, %d waypoints with steps of %.2f deg allow %.2f deg",
                       static_cast<int>(k) + 1, way / kDegree, static_cast<int>(request_.waypoints),
                       request_.max_step_rad / kDegree, most / kDegree));
    }
    return true;
  }

  bool is_short_enough(const std::vector<Vec3>& points_m) {
    double length_m = 0.0;
    for (Index i = 1; i < points_m.size(); ++i) length_m += norm(subtract(points_m[i], points_m[i - 1]));
    const double most_m = kFollowMostLengths * arm_length_m(room_.table());
    if (length_m <= most_m) return true;
    return fail(PlanOutcome::infeasible, "curve",
                text("the curve is %.1f m long; at most %.1f m are allowed, %.0f times the arm", length_m, most_m,
                     kFollowMostLengths));
  }

  // True when the search is over.
  bool through_slit(const ThetaVector& goal) {
    const FollowCurve curve = slit_curve(room_, request_.from_rad, goal);
    if (curve.points_m.empty()) return fail(PlanOutcome::infeasible, "goal", curve.reason);
    const PlanOutcome outcome = follow(Curve(curve.points_m), goal).outcome;
    return outcome == PlanOutcome::solved || outcome == PlanOutcome::cancelled;
  }

  const PlanResult& follow(const Curve& curve, const std::optional<ThetaVector>& goal) {
    result_.start = "follow";
    tell(text("following a curve of %.3f m", curve.length_m()));
    const FollowPath found = follow_path(room_, request_, curve, goal, control_);
    if (cancelled()) {
      fail(PlanOutcome::cancelled, "", "cancelled");
    } else if (found.theta_rad.empty()) {
      fail(found.constraint == "curve" ? PlanOutcome::infeasible : PlanOutcome::limit, found.constraint.c_str(),
           found.reason);
    } else {
      tell(text("%d waypoints", static_cast<int>(found.theta_rad.size())));
      if (accept(found.theta_rad)) accept_figures(follow_figures(room_.table(), found.theta_rad, curve), curve);
    }
    return result_;
  }

  bool accept_figures(const FollowStatistics& figures, const Curve& curve) {
    result_.follow = figures;
    if (room_.table().feed_count() > 0 && figures.curve_off_m > kFollowBodyOff_m) {
      const Vec3 at = curve.at(figures.curve_off_along_m).position_m;
      return fail(
          PlanOutcome::limit, "curve",
          text("segment %d leaves the curve by %.1f mm, %.3f m along it, at (%.3f, %.3f, %.3f); at most %.1f mm "
               "are allowed: bend the curve less there, or put a straight piece between its bends (the arm bends to a "
               "radius of %.2f m)",
               static_cast<int>(figures.curve_off_segment), 1000.0 * figures.curve_off_m, figures.curve_off_along_m,
               at[0], at[1], at[2], 1000.0 * kFollowBodyOff_m, least_bend_radius_m(room_.table())));
    }
    if (figures.tip_off_m <= kFollowTipOff_m * (1.0 + kRoundOff)) return true;
    return fail(PlanOutcome::limit, "tip",
                text("between waypoints the tip leaves the curve by %.3f mm; allowed are %.3f mm",
                     1000.0 * figures.tip_off_m, 1000.0 * kFollowTipOff_m));
  }

  // Tries the start paths in order; true when the search is over (solved or cancelled).
  bool search(const ThetaVector& goal) {
    const PathEnds ends{request_.from_rad, goal};
    if (control_.straight_start_only || request_.waypoints <= 2)
      return improve(straight_path(request_, ends), "straight");
    Path best;
    double best_m = -clearance::kNoObstacle_m;
    for (const StartKind kind : kStartKinds) {
      const Path path = start_path(room_, request_, ends, kind, control_);
      if (cancelled()) return !fail(PlanOutcome::cancelled, "", "cancelled");
      if (path.empty()) continue;
      const PathLook look = look_along(room_, path, kStartSpacing_m);
      tell(look.distance_m < clearance::kNoObstacle_m
               ? text("start %s: clearance %.1f mm", name_of(kind), 1000.0 * look.distance_m)
               : text("start %s: nothing in the scene", name_of(kind)));
      if (look.distance_m >= request_.margin_m && improve(path, name_of(kind))) return true;
      if (look.distance_m < request_.margin_m && look.distance_m > best_m) best = path, best_m = look.distance_m;
    }
    return !best.empty() && improve(best, "nearest to free");  // no start was free or led anywhere
  }

  // Solves in rounds, each from the best free path so far with constraints made there; true when the search is over.
  bool improve(Path path, const char* start) {
    result_.start = start;
    result_.settled = false;
    bool free = is_free(path);
    std::vector<RowSite> sites;  // where earlier solutions came too near
    for (std::int32_t round = 0; round < kMaxRounds && !result_.settled; ++round) {
      PlanProblem problem(request_, path, rows_near(room_, request_, path, sites), request_.margin_m + kInner_m,
                          free ? kStride_rad : kAnyStride_rad);
      const double before = problem.objective(problem.start().data());
      const Solution solution = solve_one(problem);
      const Path found = within_limits(problem.path_of(solution.x.data()));
      if (solution.status == SolveStatus::cancelled) return !fail(PlanOutcome::cancelled, "", "cancelled");
      const bool rows_hold = solution.worst_constraint < 0;
      if (!rows_hold && !free) return unsolved(problem, solution);
      const std::vector<RowSite> below = sites_below(room_, request_, found, request_.margin_m + kRecheck_m);
      sites.insert(sites.end(), below.begin(), below.end());
      if (rows_hold && below.empty() && steps_hold(request_, found) && tensions_hold(request_, found)) {
        result_.settled =
            free && solution.status == SolveStatus::solved && solution.objective >= (1.0 - kSettled) * before;
        path = found;
        free = true;
      } else {
        path = free ? part_of_the_way(path, found) : found;
      }
    }
    return accept(path);
  }

  bool is_free(const Path& path) const {
    return sites_below(room_, request_, path, request_.margin_m).empty() && steps_hold(request_, path) &&
           tensions_hold(request_, path);
  }

  // As far towards a solution that is not free as the way stays free; the last waypoint keeps its tip.
  Path part_of_the_way(const Path& path, const Path& found) const {
    for (double share = 0.5; share > 0.02; share *= 0.5) {
      Path part = path;
      for (Index w = 0; w + 1 < path.size(); ++w) part[w] = between(path[w], found[w], share);
      if (is_free(part)) return part;
    }
    return path;
  }

  Solution solve_one(PlanProblem& problem) {
    Solution solution;
    ++result_.rounds;
    if (problem.variables() == 0) {
      solution.status = SolveStatus::solved;
      solution.x = {0.0};
      solution.objective = problem.objective(solution.x.data());
      return solution;
    }
    tell(text("round %d: %d variables, %d constraints", static_cast<int>(result_.rounds),
              static_cast<int>(problem.variables()), static_cast<int>(problem.constraints())));
    solution = solve(problem, control_);
    result_.iterations += solution.iterations;
    return solution;
  }

  bool unsolved(const PlanProblem& problem, const Solution& solution) {
    const PlanOutcome outcome =
        solution.status == SolveStatus::infeasible ? PlanOutcome::infeasible : PlanOutcome::limit;
    return fail(outcome, problem.constraint_kind(solution.worst_constraint),
                text("the solver ended with a %s constraint violated by %.2g",
                     problem.constraint_kind(solution.worst_constraint), solution.worst_violation));
  }

  // The solver lets variables pass their bounds by 1e-8.
  Path within_limits(Path path) const {
    for (ThetaVector& theta : path) {
      for (Index k = 0; k < Index(room_.table().theta_count()); ++k) {
        const double limit = room_.table().segment[k / 2].theta_limit_rad;
        theta[k] = std::clamp(theta[k], -limit, limit);
      }
    }
    return path;
  }

  CheckedTip goal_tip(const Path& path) const {
    if (request_.tip_in_base) return {request_.tip_in_base->position_m, request_.tip_in_base->quaternion};
    CheckedTip tip = plain_tip(room_.table(), request_.to_rad.value_or(path.back()));
    if (request_.follow && !request_.follow->points_m.empty())
      tip.position_m = request_.follow->points_m.back();  // in any attitude
    return tip;
  }

  double objective(const Path& path) const {
    PlanProblem problem(request_, path, {}, 0.0, 0.0);
    return problem.objective(problem.start().data());
  }

  // The independent check decides.
  bool accept(const Path& path) {
    const Path whole = request_.waypoints == 1 ? Path{path.back()} : path;
    const PlanCheck check = check_plan(request_.robot, request_.scene, whole, goal_tip(path));
    result_.checked = check;
    result_.objective = objective(path);
    if (const auto refused = refusal_of(request_, check))
      return fail(refused->outcome, refused->constraint, refused->reason);
    result_.outcome = PlanOutcome::solved;
    result_.waypoints_rad = whole;
    result_.constraint.clear();
    result_.reason.clear();
    return true;
  }

  const PlanRequest& request_;
  const PlanControl& control_;
  Room room_;
  PlanResult result_;
};

}  // namespace

double default_max_step_rad(const RobotParams& table, std::int32_t waypoints) {
  double limit_rad = 0.0;
  for (Index m = 0; m < Index(table.segment_count); ++m)
    limit_rad = std::max(limit_rad, table.segment[m].theta_limit_rad);
  return 4.0 * limit_rad / std::max(1, waypoints - 1);
}

const char* name_of(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::solved:
      return "solved";
    case PlanOutcome::infeasible:
      return "infeasible";
    case PlanOutcome::limit:
      return "limit";
    case PlanOutcome::cancelled:
      return "cancelled";
  }
  return "";
}

PlanResult plan(const PlanRequest& request, const PlanControl& control) {
  validate(request);
  return Planner(request, control).run();
}

}  // namespace liana::planner
