#include "host/apps/launcher/validate_goals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "host/model/inverse_kinematics/serial_goal_ik.hpp"
#include "host/model/inverse_kinematics/tip_bounds.hpp"

namespace liana::launcher {
namespace {

constexpr double kSlack_m = 1e-6, kSlack_rad = 1e-6;

// What the goal search found, of either kind of arm.
struct Found {
  bool converged = false;
  std::vector<double> angles_deg;
  double position_error_m = 0.0, attitude_error_rad = 0.0;
};

std::vector<double> in_degrees(const auto& angles_rad, std::size_t count) {
  std::vector<double> out(count);
  for (std::size_t k = 0; k < count; ++k) out[k] = angles_rad[k] / kDegree;
  return out;
}

auto in_radians(const std::vector<double>& angles_deg, auto angles_rad) {
  for (std::size_t k = 0; k < angles_deg.size() && k < angles_rad.size(); ++k) angles_rad[k] = angles_deg[k] * kDegree;
  return angles_rad;
}

Pose goal_pose(const Json& numbers) {
  const auto n = numbers.get<std::vector<double>>();
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}};
}

std::string formatted(const char* format, auto... values) {
  char text[240];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string named(const Json& mission, std::size_t i) {
  const Pose goal = goal_pose(mission.at("steps")[i].at("goal_tip"));
  const Vec3& p = goal.position_m;
  return step_where(mission, i) + formatted(": run: move_cp: goal at %g, %g, %g m: ", p[0], p[1], p[2]);
}

// Why no pose of the arm has its tip there; empty where that is not known.
std::string why_never(const cable::RobotParams& table, const Pose& goal) {
  const inverse_kinematics::TipBounds bounds = inverse_kinematics::tip_bounds(table);
  const double x_m = goal.position_m[0], far_m = norm(goal.position_m);
  const double turn_rad = 2.0 * std::acos(std::min(1.0, std::fabs(goal.quaternion[0])));
  if (far_m < bounds.nearest_m - kSlack_m)
    return formatted("%.3f m from the base: bent as far as it goes the arm has its tip %.3f m away at least", far_m,
                     bounds.nearest_m);
  if (x_m < bounds.forward_m - kSlack_m)
    return formatted("its x is %g m: the joints bend the tip back to %.3f m at most", x_m, bounds.forward_m);
  if (turn_rad > bounds.turn_rad + kSlack_rad)
    return formatted("turned by %.1f deg from the straight arm: all joints together turn the tip by %.1f deg at most",
                     turn_rad / kDegree, bounds.turn_rad / kDegree);
  return "";
}

std::string not_found(const Found& found, const char* look_with) {
  return formatted("not found from where the step before leaves the arm: the nearest is %.1f mm and %.1f deg off: ",
                   1000.0 * found.position_error_m, found.attitude_error_rad / kDegree) +
         "the step will fail if it cannot be reached; look with " + look_with + ", or choose another goal";
}

// Goes through the goals in the order of the steps; search(number, step, from_deg) gives what it found.
// `look_with`: the commands that say more of a goal which is not found.
std::vector<std::string> look(const Json& mission, std::vector<double> from_deg, const char* look_with,
                              const auto& search) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < mission.at("steps").size(); ++i) {
    const Json& step = mission.at("steps")[i];
    if (step.contains("goal_deg")) from_deg = step.at("goal_deg").get<std::vector<double>>();
    if (!step.contains("goal_tip")) continue;
    const Found found = search(i, step, from_deg);
    if (found.converged) from_deg = found.angles_deg;
    if (!found.converged) notes.push_back(named(mission, i) + not_found(found, look_with));
  }
  return notes;
}

void hold(const Json& held, inverse_kinematics::GoalIkProblem& problem) {
  problem.held_rad = problem.from_rad;
  for (const Json& entry : held) {
    const auto index = static_cast<std::size_t>(entry.at("theta").get<std::int64_t>() - 1);
    problem.held_mask |= 1u << index;
    problem.held_rad[index] = entry.at("target_deg").get<double>() * kDegree;
  }
}

}  // namespace

std::string step_where(const Json& mission, std::size_t i) {
  const Json& step = mission.at("steps")[i];
  return step.value("goal_at", step.value("at", "").c_str()) + "mission " + mission.value("name", "") + ": step " +
         std::to_string(i + 1) + " \"" + step.value("name", "") + "\"";
}

std::vector<std::string> look_at_tip_goals(const Json& mission, const config::RobotConfig& robot,
                                           const std::vector<double>& start_deg) {
  const auto search = [&](std::size_t i, const Json& step, const std::vector<double>& from_deg) {
    inverse_kinematics::GoalIkProblem problem;
    problem.from_rad = in_radians(from_deg, problem.from_rad);
    problem.tip_in_base = goal_pose(step.at("goal_tip"));
    const std::string why = why_never(robot.table, problem.tip_in_base);
    if (!why.empty())
      throw BadInput(named(mission, i) + why + " (robot " + robot.name + "): choose a goal that the arm can reach");
    hold(step.at("goal_hold"), problem);
    const inverse_kinematics::GoalIkResult result = solve_goal(robot.table, problem);
    return Found{result.converged, in_degrees(result.theta_rad, start_deg.size()), result.position_error_m,
                 result.attitude_error_rad};
  };
  return look(mission, start_deg, "liana ik and liana reach", search);
}

std::vector<std::string> look_at_tip_goals(const Json& mission, const config::SerialRobotConfig& robot,
                                           const std::vector<double>& start_deg) {
  const auto search = [&](std::size_t, const Json& step, const std::vector<double>& from_deg) {
    const inverse_kinematics::SerialGoal goal{goal_pose(step.at("goal_tip")),
                                              in_radians(from_deg, serial::JointVector{})};
    const inverse_kinematics::SerialGoalResult result = solve_goal(robot.table, goal);
    return Found{result.converged, in_degrees(result.joint_rad, start_deg.size()), result.position_error_m,
                 result.attitude_error_rad};
  };
  return look(mission, start_deg, "liana ik", search);
}

}  // namespace liana::launcher
