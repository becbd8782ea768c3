// The offline planner: from joint angles to joint angles or a tip pose, past the scene
// (docs/explanation/path-planning.md).
//
// The problem (plan_problem.hpp) is solved by Ipopt with exact derivatives from a start path (start_path.hpp); the
// result is checked by code that shares nothing with either (plan_check.hpp). All limits are counts of iterations,
// never times, and every choice has a fixed order: the same request gives the same plan on one machine.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"
#include "host/model/config/config.hpp"
#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/follow/follow_statistics.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

// Waypoints; between them every theta moves evenly.
using Path = std::vector<ThetaVector>;

// Where the end of a segment (1..segment_count) should be; the planner weighs its distance with `weight` > 0.
struct ControlPoint {
  std::int32_t node = 0;
  Vec3 position_m{};
  double weight = 1.0;
};

// Theta (0-based) stands at value_rad from `from_share` (0..1) of the waypoints on, and is free before.
struct HeldPhase {
  std::int32_t theta = 0;
  double value_rad = 0.0;
  double from_share = 0.0;
};

// The tip goes along a curve through these points (base frame, at least two, neighbours apart), the body after it; no
// points: through the scene's slit to the goal.
struct FollowRequest {
  std::vector<Vec3> points_m;
};

constexpr std::int32_t kMaxWaypoints = 100;
constexpr std::size_t kMaxFollowPoints = 1000;
constexpr std::size_t kMaxControlPoints = 4;
constexpr double kDefaultMargin_m = 0.005;

struct PlanRequest {
  config::RobotConfig robot;
  config::SceneConfig scene;
  ThetaVector from_rad{};
  std::optional<ThetaVector> to_rad;    // either this
  std::optional<Pose> tip_in_base;      // or this, or
  std::optional<FollowRequest> follow;  // points alone; through the slit with one of the two above
  std::vector<HeldPhase> held;
  std::vector<ControlPoint> control_points;
  std::int32_t waypoints =
      20;  // with the ends, 2..kMaxWaypoints; 1: only the end pose, not the way; no matter when following
  double margin_m = kDefaultMargin_m;  // clearance of every link from every obstacle, also between waypoints, >= 0
  double max_step_rad = 0.0;           // of every theta between waypoints; see default_max_step_rad

  // Longest change of any cable between waypoints [m]: what it can wind while theta moves max_step_rad at its rate
  // limit.
  double max_cable_step_m() const {
    return robot.table.limits.cable_speed_m_s * max_step_rad / robot.table.limits.theta_rate_rad_s;
  }
};

// What a step may be beyond its limit, rad of a theta or m of a cable: twice what the solver leaves of a constraint
// (kConstraintTolerance), so that what it calls solved passes the check.
constexpr double kStepTolerance = 2e-7;

// Every theta may cross its whole range twice on the way.
double default_max_step_rad(const RobotParams& table, std::int32_t waypoints);
constexpr double kFollowMaxStep_rad =
    0.05;  // the same for following, where the waypoints come out as many as are needed

enum class PlanOutcome { solved, infeasible, limit, cancelled };
const char* name_of(PlanOutcome outcome);

struct PlanResult {
  PlanOutcome outcome = PlanOutcome::limit;
  Path waypoints_rad;           // empty when there is none
  double objective = 0.0;       // see plan_problem.hpp
  std::int32_t iterations = 0;  // of Ipopt, over all rounds
  std::int32_t rounds = 0;      // solves of Ipopt
  bool settled = false;  // the last solve gained less than 1 % of the objective: a local optimum, not only a valid path
  std::string start;     // which start path led here; follow when following
  std::string constraint;  // what stands in the way when not solved: start, goal, tip, step, clearance, self, cable,
                           // tension, limits, path, curve
  std::string reason;      // the same as one sentence with body, link and amount
  std::optional<FollowStatistics> follow;  // how well the body followed, when it did
  std::optional<PlanCheck> checked;  // of the path found, also when the check refused it; empty when no path was found
};

// What the planner tells while it runs, and how it is stopped.
struct PlanControl {
  std::function<void(const std::string&)> progress;  // one line; may be empty
  const std::atomic<bool>* cancelled = nullptr;      // may be set by a signal handler at any time
  std::int32_t max_iterations = 300;                 // of Ipopt in each round
  bool straight_start_only =
      false;  // for comparison: no other start than the straight line in theta, and that not relaxed
};

// Plans. Throws std::invalid_argument on a request out of range; everything else is an outcome.
PlanResult plan(const PlanRequest& request, const PlanControl& control);

// SHA-256 over robot, scene, request and waypoints: two plans with the same hash are the same plan of the same problem.
std::string plan_hash(const PlanRequest& request, const PlanResult& result);

}  // namespace liana::planner
