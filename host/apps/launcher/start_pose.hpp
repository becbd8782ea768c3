// Where a simulated arm stands when a run begins.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::launcher {

// A pose as the bench takes it, and its angles.
struct StartPose {
  std::string text;  // a name of the robot's, or angles in degrees, comma-separated
  std::vector<double> angles_deg;
};

// What `--start-pose` says: a named pose or all angles in degrees. Where nothing is given: the table's start_pose, else
// `prepare` where there is such a pose, else `zero`, or the first by name. Throws BadInput with the poses there are, or
// the range that an angle left.
StartPose start_pose_of(const config::RobotConfig& robot, const std::string& given);
StartPose start_pose_of(const config::SerialRobotConfig& robot, const std::string& given);

// For a robot that shall move its tip from where it is: of its named poses the one that is bent most, measured by its
// least bent angle, then by the sum of all; `robot` is a table's name or file, empty for the one that runs take.
std::string bent_pose(const std::string& robot);

// The body that the arm at these angles [deg] is nearest to, or in, and its link: {"body","link"}.
Json nearest_body(const config::RobotConfig& robot, const config::SceneConfig& scene,
                  const std::vector<double>& angles_deg);

// "link 3 stands 1.2 mm inside body box" where the arm at these angles [deg] is in one; empty where it is free. Cost:
// about 5 ms.
std::string inside_body(const config::RobotConfig& robot, const config::SceneConfig& scene,
                        const std::vector<double>& angles_deg);
std::string inside_body(const config::SerialRobotConfig& robot, const config::SceneConfig& scene,
                        const std::vector<double>& angles_deg);

// "link 5 stands 1.2 mm inside link 1" where a serial arm touches itself, or the arm that it stands on; else empty.
std::string inside_itself(const config::SerialRobotConfig& robot, const std::vector<double>& angles_deg);

// Throws BadInput with what these say of the start pose, where they say anything.
void check_start_is_free(const config::RobotConfig& robot, const config::SceneConfig& scene, const StartPose& start);
void check_start_is_free(const config::SerialRobotConfig& robot, const config::SceneConfig& scene,
                         const StartPose& start);

}  // namespace liana::launcher
