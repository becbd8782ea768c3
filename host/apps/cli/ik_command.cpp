#include <cstdio>

#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/pose_json.hpp"
#include "host/apps/cli/serial_commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "host/planning/planner/check/plan_check.hpp"

namespace liana::cli {
namespace {

// Fixes the held angles, at their own value where one was given.
void hold(const std::string& text, const cable::RobotParams& robot, inverse_kinematics::GoalIkProblem& problem) {
  problem.held_rad = problem.from_rad;
  if (text.empty()) return;
  for (const HoldArgument& held : parse_hold(text, robot)) {
    const auto index = static_cast<std::size_t>(held.theta - 1);
    problem.held_mask |= 1u << index;
    if (held.has_value) problem.held_rad[index] = held.value_deg * kDegree;
  }
}

void aim_nodes(const std::vector<std::string>& texts, const cable::RobotParams& robot,
               inverse_kinematics::GoalIkProblem& problem) {
  if (texts.size() > problem.node.size()) {
    throw launcher::BadInput("--control-point: " + std::to_string(texts.size()) + " given: allowed: at most " +
                             std::to_string(problem.node.size()));
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const ControlPointArgument point = parse_control_point(texts[i], robot);
    problem.node[i] = {point.node, point.position_m, point.weight, 0.0};
  }
}

Json to_json(const inverse_kinematics::GoalIkResult& result, std::size_t theta_count, std::size_t node_count) {
  const Json theta = degrees_json(result.theta_rad, static_cast<std::int32_t>(theta_count));
  Json distances = Json::array(), reaches = Json::array();
  for (std::size_t i = 0; i < node_count; ++i) {
    distances.push_back(result.node_distance_m[i]);
    reaches.push_back({{"now", result.node_reach[i].now_m}, {"least", result.node_reach[i].least_m}});
  }
  return {{"theta_deg", theta},
          {"converged", result.converged},
          {"iterations", result.iterations},
          {"position_error_m", result.position_error_m},
          {"attitude_error_rad", result.attitude_error_rad},
          {"node_distance_m", distances},
          {"node_reach_m", reaches}};
}

void print_goal(const Json& answer) {
  std::printf("%s after %d iterations, error %.2e m, %.2e rad\ntheta (deg):",
              answer["converged"].get<bool>() ? "converged" : "not converged", answer["iterations"].get<int>(),
              answer["position_error_m"].get<double>(), answer["attitude_error_rad"].get<double>());
  for (const Json& angle : answer["theta_deg"]) std::printf(" %.6f", angle.get<double>());
  std::printf("\n");
  if (!answer["refused"].is_null()) std::printf("refused: %s\n", answer["refused"].get<std::string>().c_str());
}

}  // namespace

int ik_command(const IkOptions& options) {
  if (const auto serial = launcher::serial_robot_for_kinematics(options.robot))
    return serial_ik_command(*serial, options);
  const config::RobotConfig arm = launcher::robot_for_kinematics(options.robot);
  const cable::RobotParams& robot = arm.table;
  inverse_kinematics::GoalIkProblem problem;
  problem.from_rad = parse_pose_deg("--from-deg", options.from_deg, arm);
  problem.tip_in_base = parse_pose("--tip", options.tip);
  hold(options.hold, robot, problem);
  aim_nodes(options.control_points, robot, problem);
  const inverse_kinematics::GoalIkResult result = inverse_kinematics::solve_goal(robot, problem);
  planner::PlanCheck check;
  planner::check_tension(robot, {result.theta_rad}, check);
  const std::string refused = planner::tension_refusal(robot, check, robot.tension.ceiling_free_N);
  Json answer = to_json(result, static_cast<std::size_t>(robot.theta_count()), options.control_points.size());
  answer["min_tension_N"] = check.min_tension_N;
  answer["max_tension_N"] = check.max_tension_N;
  answer["refused"] = refused.empty() ? Json() : Json(refused);
  if (options.json) {
    std::puts(answer.dump().c_str());
  } else {
    print_goal(answer);
  }
  if (!result.converged) return launcher::kExitNotConverged;
  return refused.empty() ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
