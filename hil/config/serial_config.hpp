// A robot with a serial arm as the bench reads it from JSON (docs/reference/formats.md). SI units, radians.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hil/config/robot_config.hpp"
#include "hil/math/vec3.hpp"

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

// A rigid body in a frame: centre of mass, inertia about it along the frame's axes (xx, yy, zz, xy, xz, yz).
struct BodyConfig {
  double mass_kg = 0.0;
  Vec3 center_m;
  std::array<double, 6> inertia_kgm2{};
};

struct LockedBaseConfig;

struct SerialRobotConfig {
  std::vector<JointConfig> joints;
  std::vector<BodyConfig> links;  // in the frame at each link's end; empty: drawn as spheres and rods, as follows
  double module_kg = 0.0;         // of each joint, as a sphere
  double module_radius_m = 0.0;   // of it
  double boom_kg = 0.0;           // of each link with a length along x, as a rod
  double boom_radius_m = 0.05;    // of it
  double end_effector_kg = 0.0;   // at the tip, as a sphere
  double link_radius_m = 0.0;     // of a capsule about every link, with all that is mounted on it
  double coulomb_Nm = 0.0;
  double viscous_Nms_per_rad = 0.0;
  double rotor_inertia_kgm2 = 0.0;        // reflected to the joint
  double gear_damping_Nms_per_rad = 0.0;  // across the gear's spring
  std::vector<double> stiffness_Nm_rad;   // of each joint's gear; empty where the table does not say
  std::uint32_t counts_per_turn = 0;
  double gear = 1.0;
  double servo_time_constant_s = 0.0;
  double rated_torque_Nm = 0.0;
  double peak_torque_Nm = 0.0;        // that the drives can give
  bool is_torque_controlled = false;  // its drives have joint torque sensors and cyclic synchronous torque
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::vector<DriveConfig> drives;
  double fastest_counts_per_s = 0.0;  // command that the table allows; 0 where it does not say
  std::map<std::string, std::vector<double>> named_poses_rad;
  std::shared_ptr<const LockedBaseConfig> base;  // the arm that this one stands on; none: it stands firm

  // Joint angle per encoder count [rad].
  double rad_per_count() const;
};

// An arm with locked joints that carries another at its tip: springs about its joints' axes.
struct LockedBaseConfig {
  SerialRobotConfig robot;
  std::vector<double> joint_rad;  // where it locks, without load
  double carry_s = 0.0;           // how long its own controller takes to carry from another pose; 0: it does not
  double damping_s = 0.0;         // of the springs: their damping is so many seconds of their stiffness
};

// True when the file describes a serial arm; throws std::runtime_error when it cannot be read.
bool is_serial_robot(const std::string& path);

// Reads and checks a robot; throws std::runtime_error naming file, field, value and allowed range.
SerialRobotConfig load_serial_robot(const std::string& path);

}  // namespace liana::bench
