// Robots with a serial arm (kind "serial"): canonical JSON (docs/reference/formats.md) to a checked struct, as
// config.hpp does it for cable arms.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/serial/mass_table.hpp"
#include "firmware_like/serial/robot_params.hpp"
#include "host/model/config/config.hpp"

namespace liana::config {

// The arm whose tip carries this one, its joints locked: where the base of this one is, and how it gives way.
struct LockedBase {
  std::string name;                 // of the robot that carries
  serial::RobotParams table{};      // without drives of its own: tick and T_c stay 0
  serial::MassTable masses{};       // of its links
  serial::JointVector joint_rad{};  // at which its joints are locked
  std::map<std::string, serial::JointVector> named_poses_rad;
  double carry_s = 0.0;                    // how long it takes to carry there from another pose; 0: it does not
  serial::JointVector stiffness_Nm_rad{};  // of each, about its axis
  double link_radius_m = 0.0;
};

// What the core needs (table) and what only the host needs.
struct SerialRobotConfig {
  std::string name;
  serial::RobotParams table{};  // tick and T_c included
  serial::MassTable masses{};   // without a load at the tip
  DriveIdentity identity{};
  double link_radius_m = 0.0;            // of a capsule about every link, with all that is mounted on it
  double rated_torque_Nm = 0.0;          // 6076, at the joint
  double peak_torque_Nm = 0.0;           // that the drives can give for a while, at the joint
  std::vector<double> stiffness_Nm_rad;  // of every joint, about its axis; empty: the table does not say
  std::uint32_t counts_per_turn = 0;
  double gear = 1.0;                                           // encoder turns per joint turn
  std::vector<std::uint32_t> drive_serials;                    // what 0x1018:4 must say; empty: anything
  std::int32_t calibration_days = 0;                           // how old a calibration may be
  std::map<std::string, std::vector<double>> named_poses_deg;  // joint_count angles each
  std::string start_pose;            // which of them a simulated arm begins with; empty: the table does not say
  bool has_wrist_sensor = false;     // on one of its buses
  bool has_adapter = false;          // the same
  serial::InsertGains push_gains{};  // that a push has which says nothing of them; torque drives only
  std::optional<LockedBase> base;    // the arm that this one stands on; none: it stands firm
  std::string canonical_json;
};

// What kind of arm a robot table describes: "robot" (cables) or "serial"; empty when it has no kind that is text.
std::string kind_of(const Json& table);

// The same of JSON text that was checked once; throws when it is no JSON.
std::string robot_kind(const std::string& text, const std::string& file);

// True when the scene fetches its payload with the arm below at another pose than where that is locked.
bool is_carried(const SerialRobotConfig& robot, const SceneConfig& scene);

// Why the arm below cannot carry this one from there: a pose that it does not have, no `carry_s`, or joints that would
// turn faster than they may. Empty where it can, or need not.
std::string why_not_carried(const SerialRobotConfig& robot, const SceneConfig& scene);

// True when its drives follow torques (docs/explanation/force-control.md).
inline bool is_torque_controlled(const SerialRobotConfig& robot) {
  return robot.table.torque.is_torque_controlled != 0;
}

// Whether the file describes a serial robot; throws when it cannot be read or is no JSON.
bool is_serial_robot(const std::string& path);

// Loads and checks a serial robot for these buses (every drive on exactly one bus). Throws std::runtime_error
// "file: field: value: allowed ...: what to do" on the first fault it finds.
SerialRobotConfig load_serial_robot(const std::string& path, const BusesConfig& buses);

// The same from JSON text; `file` is what messages call it.
SerialRobotConfig parse_serial_robot(const std::string& text, const std::string& file, const BusesConfig& buses);

// For kinematics alone: without buses, tick and T_c stay 0.
SerialRobotConfig parse_serial_robot(const std::string& text, const std::string& file);

// Checks the table by itself, without buses, and returns its canonical JSON.
std::string check_serial_robot(const Json& table, const std::string& file);

}  // namespace liana::config
