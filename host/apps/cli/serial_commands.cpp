#include "host/apps/cli/serial_commands.hpp"

#include <cstdio>

#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/pose_json.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/model/inverse_kinematics/serial_goal_ik.hpp"

namespace liana::cli {
namespace {

Json pose_of(const serial::RobotParams& table, const serial::JointVector& joint_rad) {
  const serial::ArmKinematics arm = forward_kinematics(table, joint_rad);
  Json points = Json::array();
  for (std::size_t i = 0; i <= table.joints(); ++i) points.push_back(arm.point_in_base[i]);
  return {{"tip_pose", homogeneous(arm.tip_in_base)},
          {"joint_points_m", points},
          {"jacobian", jacobian_rows(arm.tip_jacobian.linear, arm.tip_jacobian.angular, table.joint_count)}};
}

void print_pose(const Json& pose) {
  for (const Json& row : pose["tip_pose"]) {
    std::printf("%10.6f %10.6f %10.6f %11.6f m\n", row[0].get<double>(), row[1].get<double>(), row[2].get<double>(),
                row[3].get<double>());
  }
}

Json to_json(const inverse_kinematics::SerialGoalResult& result, std::size_t joints) {
  return {{"theta_deg", degrees_json(result.joint_rad, static_cast<std::int32_t>(joints))},
          {"converged", result.converged},
          {"iterations", result.iterations},
          {"position_error_m", result.position_error_m},
          {"attitude_error_rad", result.attitude_error_rad},
          {"move_s", result.move_s}};
}

void print_ik(const Json& answer) {
  std::printf("%s after %d iterations, error %.2e m, %.2e rad\ntheta (deg):",
              answer["converged"].get<bool>() ? "converged" : "not converged", answer["iterations"].get<int>(),
              answer["position_error_m"].get<double>(), answer["attitude_error_rad"].get<double>());
  for (const Json& angle : answer["theta_deg"]) std::printf(" %.6f", angle.get<double>());
  std::printf("\nfrom the start in %.1f s at full rate\n", answer["move_s"].get<double>());
}

}  // namespace

void refuse_cable_option(const char* option, const std::string& value, const config::SerialRobotConfig& robot,
                         const char* what_to_do) {
  if (value.empty()) return;
  throw launcher::BadInput(std::string(option) + ": '" + value + "': allowed with cable arms only: robot " +
                           robot.name + " has a serial arm; " + what_to_do);
}

int serial_pose_command(const config::SerialRobotConfig& robot, const PoseOptions& options) {
  refuse_cable_option("--scene", options.scene, robot);
  const Json pose = pose_of(robot.table, parse_pose_deg("--theta-deg", options.theta_deg, robot));
  if (options.json) {
    std::puts(pose.dump().c_str());
  } else {
    print_pose(pose);
  }
  return launcher::kExitOk;
}

int serial_ik_command(const config::SerialRobotConfig& robot, const IkOptions& options) {
  refuse_cable_option("--hold", options.hold, robot);
  for (const std::string& point : options.control_points) refuse_cable_option("--control-point", point, robot);
  const inverse_kinematics::SerialGoal goal{parse_pose("--tip", options.tip),
                                            parse_pose_deg("--from-deg", options.from_deg, robot)};
  const inverse_kinematics::SerialGoalResult result = solve_goal(robot.table, goal);
  const Json answer = to_json(result, robot.table.joints());
  if (options.json) {
    std::puts(answer.dump().c_str());
  } else {
    print_ik(answer);
  }
  return result.converged ? launcher::kExitOk : launcher::kExitNotConverged;
}

}  // namespace liana::cli
