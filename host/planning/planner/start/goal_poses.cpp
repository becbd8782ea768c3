#include "host/planning/planner/start/goal_poses.hpp"

#include <algorithm>
#include <cmath>

#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "host/planning/planner/start/relax.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr std::int32_t kPushIterations = 30;
constexpr double kSame_rad = 0.02;
constexpr double kClearWeight = 100.0;  // against control points

inverse_kinematics::GoalIkProblem ik_problem(const PlanRequest& request) {
  inverse_kinematics::GoalIkProblem problem;
  problem.tip_in_base = *request.tip_in_base;
  for (const HeldPhase& phase : request.held) {
    problem.held_mask |= 1u << phase.theta;
    problem.held_rad[Index(phase.theta)] = phase.value_rad;
  }
  for (Index i = 0; i < request.control_points.size(); ++i) {
    const ControlPoint& point = request.control_points[i];
    problem.node[i] = {point.node, point.position_m, point.weight, 0.0};
  }
  return problem;
}

// Pitch (axis 0) or yaw (1) of the last `segments` segments at 0; what is held already stays.
inverse_kinematics::GoalIkProblem with_planar_end(inverse_kinematics::GoalIkProblem problem, const RobotParams& table,
                                                  std::int32_t segments, std::int32_t axis) {
  for (std::int32_t m = std::max(0, table.segment_count - segments); m < table.segment_count; ++m) {
    const std::int32_t theta = 2 * m + axis;
    if (((problem.held_mask >> theta) & 1u) == 0) problem.held_rad[Index(theta)] = 0.0;
    problem.held_mask |= 1u << theta;
  }
  return problem;
}

// Also wanted of the shape: clear of the spheres that are nearest to a pose.
inverse_kinematics::GoalIkProblem with_clear_spheres(inverse_kinematics::GoalIkProblem problem, const Room& room,
                                                     const ThetaVector& theta, double clearance_m) {
  const LinkPoints points = link_points(room.table(), theta);
  std::vector<std::pair<double, Index>> near;
  for (Index i = 0; i < room.scene().spheres.size(); ++i) {
    double least_m = clearance::kNoObstacle_m;
    for (std::int32_t link = 0; link + 1 < points.count; ++link) {
      least_m =
          std::min(least_m, clearance::clearance(clearance::link_capsule(points.axis(), link, room.link_radius_m()),
                                                 room.scene().spheres[i])
                                .distance_m);
    }
    near.push_back({least_m, i});
  }
  std::sort(near.begin(), near.end());
  for (Index i = 0; i < std::min(near.size(), problem.clear.size()); ++i) {
    const config::SceneSphere& sphere = room.scene().spheres[near[i].second];
    problem.clear[i] = {sphere.center_m, sphere.radius_m + room.link_radius_m() + clearance_m, kClearWeight};
  }
  return problem;
}

// A pose and its clearance.
struct Candidate {
  ThetaVector theta_rad{};
  double clearance_m = -clearance::kNoObstacle_m;
};

// The pose that goal IK finds, pushed off obstacles where that helps; false when it finds none.
bool find_pose(const Room& room, const PlanRequest& request, const inverse_kinematics::GoalIkProblem& problem,
               Candidate& out) {
  const inverse_kinematics::GoalIkResult found = inverse_kinematics::solve_goal(room.table(), problem);
  if (!found.converged) return false;
  out = {found.theta_rad, room.look(found.theta_rad).nearest.distance_m};
  if (out.clearance_m >= request.margin_m) return true;
  const PoseAim aim{*request.tip_in_base, false, found.theta_rad, problem.held_mask, request.margin_m + kRelaxReach_m};
  inverse_kinematics::GoalIkProblem beside = problem;
  beside.node = {};
  beside.clear = {};
  beside.from_rad = settle(room, aim, found.theta_rad, kPushIterations).theta_rad;
  const inverse_kinematics::GoalIkResult exact =
      inverse_kinematics::solve_goal(room.table(), beside);  // the push leaves the tip some micrometres off
  const double clearance_m = room.look(exact.theta_rad).nearest.distance_m;
  if (exact.converged && clearance_m > out.clearance_m) out = {exact.theta_rad, clearance_m};
  return true;
}

}  // namespace

ThetaVector seed_pose(const RobotParams& table, const ThetaVector& from, std::int32_t seed) {
  if (seed == 0) return from;
  ThetaVector theta{};
  for (Index k = 0; k < Index(table.theta_count()); ++k) {
    const double sign = (Index(seed) * (k + 1) * 2654435761u >> 7) % 2 == 0 ? 1.0 : -1.0;
    if (k < Index(table.feed_count())) {
      theta[k] = from[k];  // a base that feeds stays: the arm's shape is sought
    } else if (seed > 1) {
      theta[k] = 0.5 * sign * table.segment[k / 2].theta_limit_rad;
    }
  }
  return theta;
}

GoalPoses goal_poses(const Room& room, const PlanRequest& request) {
  GoalPoses out;
  std::vector<inverse_kinematics::GoalIkProblem> problems;
  for (std::int32_t seed = 0; seed < kGoalPoseSeeds; ++seed) {
    problems.push_back(ik_problem(request));
    problems.back().from_rad = seed_pose(room.table(), request.from_rad, seed);
  }
  for (const std::int32_t segments : {1, 2}) {
    for (const std::int32_t axis : {0, 1})
      problems.push_back(with_planar_end(problems.front(), room.table(), segments, axis));
  }
  double max_clearance = -clearance::kNoObstacle_m;
  const auto try_problem = [&](const inverse_kinematics::GoalIkProblem& problem) {
    Candidate pose;
    if (!find_pose(room, request, problem, pose)) return;
    out.reachable = true;
    if (pose.clearance_m > max_clearance) max_clearance = pose.clearance_m, out.nearest_rad = pose.theta_rad;
    const auto same = [&](const ThetaVector& other) { return largest_change(other, pose.theta_rad) < kSame_rad; };
    const bool known = std::any_of(out.theta_rad.begin(), out.theta_rad.end(), same);
    if (pose.clearance_m >= request.margin_m && !known) out.theta_rad.push_back(pose.theta_rad);
  };
  for (const inverse_kinematics::GoalIkProblem& problem : problems) try_problem(problem);
  if (out.reachable && out.theta_rad.empty())
    try_problem(with_clear_spheres(problems.front(), room, out.nearest_rad, request.margin_m + kRelaxReach_m));
  std::stable_sort(out.theta_rad.begin(), out.theta_rad.end(), [&](const ThetaVector& a, const ThetaVector& b) {
    return room.motion_m(request.from_rad, a) < room.motion_m(request.from_rad, b);
  });
  if (out.theta_rad.size() > Index(kGoalPoses)) out.theta_rad.resize(Index(kGoalPoses));
  return out;
}

}  // namespace liana::planner
