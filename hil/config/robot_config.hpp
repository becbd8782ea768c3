// The robot table as the bench reads it from JSON (docs/reference/formats.md). SI units, radians.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
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

// A carriage that slides along x of the base frame and then turns about that x; the arm starts on it. Two angles stand
// for both, the slide's first, each moved by a drive of its own.
struct BaseConfig {
  double limit_rad = 0.0;        // of both angles
  double slide_m_per_rad = 0.0;  // x of the carriage per angle, 0 in the middle of the travel
  double roll_radius_m = 0.0;    // of the wheel that turns it
  double mass_kg = 0.0;          // of the carriage
  // What the drives of slide and roll move per angle [m/rad].
  std::array<double, 2> metres_per_rad() const { return {slide_m_per_rad, roll_radius_m}; }
};
constexpr std::size_t kBaseDrives = 2;

// What a drive is told about itself; first those of a base, then one per cable.
struct DriveConfig {
  int direction = 1;         // +1: counts grow while cable is paid out, or slide and roll go on
  double zero_counts = 0.0;  // counts at payout = path at the zero pose + lead
  std::uint32_t serial = 0;  // 1018:4
};

struct RobotConfig {
  std::optional<BaseConfig> base;
  std::vector<SegmentConfig> segments;  // with a base the first stands for it: no module, no cable
  Vec3 gravity_m_s2;                    // in the base frame
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
  std::size_t drive_count() const { return drives.size(); }
  // Drives that move no cable: they come first.
  std::size_t base_drives() const { return base ? kBaseDrives : 0; }
  // First of the segments that bend.
  std::size_t first_bending() const { return base ? 1 : 0; }
  // Cable paid out per encoder count [m].
  double metres_per_count() const;
  // The table's path of a cable that ends in `segment`, arm straight [m].
  double path_at_zero_m(std::size_t segment) const;
  // The same of every drive. That of slide and roll is what they move from the middle to the end, so none is negative.
  std::vector<double> paths_at_zero_m() const;
};

// Reads and checks a robot; throws std::runtime_error naming file, field, value and allowed range.
RobotConfig load_robot(const std::string& path);

}  // namespace liana::bench
