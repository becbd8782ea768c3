// The check of a plan: limits, clearances, cables and goal, from first principles.
//
// Shares no code with the planner, its derivatives or the core (but for the tension plan, about which the core is
// asked): the arm is the product of its 80 joint rotations one by one, link distances come from a search along the
// link (from libccd for convex bodies), cable lengths from hole to hole. Between waypoints the path is halved until the
// arm cannot have come nearer unseen: no point of it moves more than kUnseen_m between two poses looked at where it
// matters (path_search.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/model/config/config.hpp"
#include "host/planning/planner/check/self_check.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

struct PlanCheck {
  double min_clearance_m = 0.0;   // over the whole path, every link and obstacle; without obstacles kNothingNear_m
  std::string nearest;            // obstacle where it is, empty without
  std::int32_t nearest_link = 0;  // from 1
  SelfClearance self{};           // of the arm from itself, over the whole path
  double max_joint_deg = 0.0;     // largest |theta|
  double over_limit_deg = 0.0;    // largest excess of a theta over its own limit, 0 when within
  double max_step_deg = 0.0;      // largest change of a theta between waypoints
  double max_cable_step_m = 0.0;  // largest change of a cable's length between waypoints
  double tip_error_m = 0.0;       // last waypoint against the goal (tip pose, or the tip of the goal angles)
  double tip_attitude_error_rad = 0.0;
  double min_tension_N = 0.0;  // of the core's tension plan at the motors, at the waypoints, without friction's history
  double max_tension_N = 0.0;
  std::int32_t min_tension_cable = 0, max_tension_cable = 0;  // 0-based
  double duration_s = 0.0;  // shortest time within the theta rate and cable speed limits
  std::int64_t poses = 0;   // looked at
};
constexpr double kNothingNear_m = 1e3;

// A tip pose as the checker wants it.
struct CheckedTip {
  std::array<double, 3> position_m{};
  std::array<double, 4> quaternion_wxyz{};
};

// The tensions alone, at the poses of a path.
void check_tension(const RobotParams& table, const std::vector<ThetaVector>& path_rad, PlanCheck& out);
// Why the cables must not be pulled so: cable, newtons, what is allowed, what to do. Empty: floor and ceiling are kept.
std::string tension_refusal(const RobotParams& table, const PlanCheck& check, double ceiling_N);

// Checks waypoints [rad] against the scene. `goal` is where the tip has to end. A path of one waypoint is a single
// pose.
PlanCheck check_plan(const config::RobotConfig& robot, const config::SceneConfig& scene,
                     const std::vector<ThetaVector>& waypoints_rad, const CheckedTip& goal);

// Tip of joint angles by the plain product of joints.
CheckedTip plain_tip(const RobotParams& table, const ThetaVector& theta_rad);

// The same way: ends of all links, base frame; the base comes first.
std::vector<std::array<double, 3>> plain_axis(const RobotParams& table, const ThetaVector& theta_rad);

}  // namespace liana::planner
