// A robot with a serial arm as the bench reads it from JSON (docs/formats.md). SI units, radians.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hil/config/robot_config.hpp"

namespace liana::bench {

// One revolute joint and the link behind it: turn about z, d along z, a along the new x, turn by alpha about the new x.
struct JointConfig {
  double alpha_rad = 0.0;
  double a_m = 0.0;
  double d_m = 0.0;
  double offset_rad = 0.0;
  double low_rad = 0.0;
  double high_rad = 0.0;
  double rate_rad_s = 0.0;  // fastest command; 0 where the table does not say
};

struct SerialRobotConfig {
  std::vector<JointConfig> joints;
  double module_kg = 0.0;        // of each joint, as a sphere
  double module_radius_m = 0.0;  // of it
  double boom_kg = 0.0;          // of each link with a length along x, as a rod
  double end_effector_kg = 0.0;  // at the tip, as a sphere
  double coulomb_Nm = 0.0;
  double viscous_Nms_per_rad = 0.0;
  double rotor_inertia_kgm2 = 0.0;  // reflected to the joint
  std::uint32_t counts_per_turn = 0;
  double gear = 1.0;
  double servo_time_constant_s = 0.0;
  double rated_torque_Nm = 0.0;
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::vector<DriveConfig> drives;
  double fastest_counts_per_s = 0.0;  // command that the table allows; 0 where it does not say
  std::map<std::string, std::vector<double>> named_poses_rad;

  // Joint angle per encoder count [rad].
  double rad_per_count() const;
};

// True when the file describes a serial arm; throws std::runtime_error when it cannot be read.
bool is_serial_robot(const std::string& path);

// Reads and checks a robot; throws std::runtime_error naming file, field, value and allowed range.
SerialRobotConfig load_serial_robot(const std::string& path);

}  // namespace liana::bench
