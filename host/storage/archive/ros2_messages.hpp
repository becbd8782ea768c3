// Messages of ROS 2 as CDR (little-endian, with the header of its encapsulation), and their definitions.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::archive::ros2 {

// Definition of a message that is written here ("sensor_msgs/msg/JointState") and, behind it, of all that it is made
// of, as the schema encoding `ros2msg` has them. Throws std::invalid_argument for another name.
std::string definition_of(const std::string& name);

// When, and in which frame.
struct Header {
  std::uint64_t time_ns = 0;
  std::string frame{};
};

struct JointState {
  std::vector<std::string> names;
  std::vector<double> positions, efforts;  // rad or m, N m; no efforts: none are known
};
std::string joint_state(const Header& header, const JointState& joints);

struct Transform {
  std::string parent, child;
  Pose pose{};
};
// tf2_msgs/msg/TFMessage, all of the same time.
std::string transforms(std::uint64_t time_ns, const std::vector<Transform>& transforms);

std::string pose(const Header& header, const Pose& pose);
// What is not known is NaN.
std::string wrench(const Header& header, const Vec3& force_N, const Vec3& torque_Nm);

struct Diagnostic {
  std::uint8_t level = 0;  // 0 good, 1 warning, 2 error
  std::string name, message, hardware;
  std::vector<std::pair<std::string, std::string>> values;
};
// diagnostic_msgs/msg/DiagnosticArray with one status.
std::string diagnostics(const Header& header, const Diagnostic& status);

// std_msgs/msg/String.
std::string text(const std::string& value);

// `offered_qos_profiles` of a channel, as rosbag2 keeps it: reliable; latched: the newest message waits for those who
// subscribe later.
std::string quality_of_service(bool is_latched);

}  // namespace liana::archive::ros2
