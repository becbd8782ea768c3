// The values of command line options: strict readers that name the option, the value and what is allowed. All throw
// BadInput.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::config {
struct RobotConfig;
struct SerialRobotConfig;
}  // namespace liana::config

namespace liana::cli {

// One held variable: theta counted from 1, and its value where one was given [deg].
struct HoldArgument {
  std::int32_t theta = 0;
  bool has_value = false;
  double value_deg = 0.0;
};

// Where a node should go: node counted from 1 (the end of that segment), base frame.
struct ControlPointArgument {
  std::int32_t node = 0;
  Vec3 position_m{};
  double weight = 1.0;
};

// A finite number, all of `text`.
double parse_number(std::string_view option, std::string_view text);

// A finite number from `least` to `most`; `unit` is for the message.
double parse_number_in(std::string_view option, std::string_view text, double least, double most,
                       std::string_view unit);

// A whole number from `least` to `most`; `note`, if any, is added to what the message allows.
std::int64_t parse_whole(std::string_view option, std::string_view text, std::int64_t least, std::int64_t most,
                         std::string_view note = "");

// A node, which is the end of a segment, counted from 1.
std::int32_t parse_node(std::string_view option, std::string_view text, const cable::RobotParams& robot);

// A whole number from 0 to 2^53 - 1, the largest that JSON keeps exactly.
std::uint64_t parse_seed(std::string_view option, std::string_view text);

// Comma-separated finite numbers, exactly `count` of them.
std::vector<double> parse_numbers(std::string_view option, std::string_view text, std::size_t count);

// Joint angles in degrees within the robot's limits, as radians; entries beyond the robot's are 0. An angle up to 1e-6
// rad beyond its limit is taken as the limit, and a note on standard error says so; the same below.
cable::ThetaVector parse_theta_deg(std::string_view option, std::string_view text, const cable::RobotParams& robot);

// The angles of a serial arm's joints in degrees, from the base to the tip, within their ranges.
serial::JointVector parse_joint_deg(std::string_view option, std::string_view text, const serial::RobotParams& robot);

// The same, or the name of a pose of the robot.
cable::ThetaVector parse_pose_deg(std::string_view option, const std::string& text, const config::RobotConfig& robot);
serial::JointVector parse_pose_deg(std::string_view option, const std::string& text,
                                   const config::SerialRobotConfig& robot);

// Refuses a word that is no pose of the robot: `count` angles, or the name of one of `poses`, are allowed.
[[noreturn]] void refuse_pose(std::string_view option, std::string_view text, std::size_t count,
                              const std::string& robot, const std::map<std::string, std::vector<double>>& poses);

// x,y,z,qw,qx,qy,qz: metres in the base frame within +-1000, quaternion of unit length within 1e-6.
Pose parse_pose(std::string_view option, std::string_view text);

// 7,9 or 7=0.5,9: variables to hold, each at most once, values in degrees within the robot's limits.
std::vector<HoldArgument> parse_hold(std::string_view text, const cable::RobotParams& robot);

// 3:x,y,z:weight: metres within +-1000; the weight, over 0 up to 1000, may be left out.
ControlPointArgument parse_control_point(std::string_view text, const cable::RobotParams& robot);

}  // namespace liana::cli
