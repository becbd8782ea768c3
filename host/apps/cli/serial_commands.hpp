// `pose` and `ik` of serial arms, and what commands of both kinds refuse for them.
#pragma once

#include "host/apps/cli/commands.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::cli {

// Throws BadInput when an option that only cable arms have was given (its value is not empty).
void refuse_cable_option(const char* option, const std::string& value, const config::SerialRobotConfig& robot,
                         const char* what_to_do = "leave it out");

// Forward kinematics of one pose. A scene is refused: serial arms have no slit to look at.
int serial_pose_command(const config::SerialRobotConfig& robot, const PoseOptions& options);

// The goal solver; exit code 3 when it did not converge. Held variables and control points are refused.
int serial_ik_command(const config::SerialRobotConfig& robot, const IkOptions& options);

}  // namespace liana::cli
