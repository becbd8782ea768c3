// The robot table as the bench reads it from JSON (docs/reference/formats.md). SI units, radians.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hil/math/vec3.hpp"

namespace liana::bench {

// One segment: `modules` universal joints bent by the same two angles; odd modules turn pitch first.
struct SegmentConfig {
  int modules = 0;
  double module_length_m = 0.0;
  double theta_limit_rad = 0.0;
  std::vector<double> cable_phase_rad;
  double hole_radius_m = 0.0;  // of the cables that end here, in every disc that they pass
  double face_offset_m = 0.0;  // disc faces before and after a joint centre
  double module_mass_kg = 0.0;
  double module_center = 0.5;           // of a module's length, from the root's side
  double joint_stiffness_Nm_rad = 0.0;  // of one joint, about both axes
  std::array<double, 2> joint_rest_rad{};
};

// What a drive is told about itself; one per cable.
struct DriveConfig {
  int direction = 1;         // +1: counts grow while cable is paid out
  double zero_counts = 0.0;  // counts at payout = path at the zero pose + lead
  std::uint32_t serial = 0;  // 1018:4
};

struct RobotConfig {
  std::vector<SegmentConfig> segments;
  Vec3 gravity_m_s2;  // in the base frame
  double tool_kg = 0.0;
  Vec3 tool_center_m;  // in the tip's frame
  double module_radius_m = 0.0;
  double viscous_Nms_per_rad = 0.0;  // per theta
  double cable_EA_N = 0.0;
  double plan_tension_N = 0.0;
  double lead_m = 0.0;
  std::map<std::string, double> friction_mu;  // by physics name
  double drum_radius_m = 0.0;
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

  std::size_t theta_count() const { return 2 * segments.size(); }
  std::size_t link_count() const {
    std::size_t count = 0;
    for (const SegmentConfig& segment : segments) count += static_cast<std::size_t>(segment.modules);
    return count;
  }
  std::size_t cable_count() const { return drives.size(); }
  // Cable paid out per encoder count [m].
  double metres_per_count() const;
  // The table's path of a cable that ends in `segment`, arm straight [m].
  double path_at_zero_m(std::size_t segment) const;
};

// Reads and checks a robot; throws std::runtime_error naming file, field, value and allowed range.
RobotConfig load_robot(const std::string& path);

}  // namespace liana::bench
