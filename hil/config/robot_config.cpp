#include "hil/config/robot_config.hpp"

#include <algorithm>
#include <numbers>

#include "hil/config/fields.hpp"
#include "hil/config/json_file.hpp"
#include "hil/math/reduced.hpp"

namespace liana::bench {

namespace {

constexpr double kMostBase_deg = 360.0;

double number_or(const JsonFile& file, const std::string& field, double low, double high, double otherwise) {
  return file.has(field) ? file.number(field, low, high) : otherwise;
}

// What a segment's modules weigh and how their joints spring: its own fields, else those of all.
void read_module(const JsonFile& file, const std::string& at_segment, SegmentConfig& segment) {
  segment.module_mass_kg =
      number_or(file, at_segment + "/module_mass_kg", 1e-6, 100.0, file.number("/module/mass_kg", 1e-6, 100.0));
  segment.module_center =
      number_or(file, at_segment + "/module_center", 0.0, 1.0, number_or(file, "/module/center", 0.0, 1.0, 0.5));
  segment.joint_stiffness_Nm_rad = number_or(file, at_segment + "/joint_stiffness_Nm_per_rad", 0.0, 1e4,
                                             number_or(file, "/joint/stiffness_Nm_per_rad", 0.0, 1e4, 0.0));
  const std::string own = at_segment + "/joint_rest_deg", all = "/joint/rest_deg";
  if (!file.has(own) && !file.has(all)) return;
  const std::vector<double> rest_deg = file.numbers(file.has(own) ? own : all, 2, -45.0, 45.0);
  segment.joint_rest_rad = {kRadPerDeg * rest_deg[0], kRadPerDeg * rest_deg[1]};
}

// Of segment `m`: a number is that of all segments, a list has one for each.
double number_of_segment(const JsonFile& file, const std::string& field, std::size_t m, double low, double high) {
  if (!file.is_list(field)) return file.number(field, low, high);
  return file.numbers(field, file.size("/segments"), low, high)[m];
}

void read_weight(const JsonFile& file, RobotConfig& robot) {
  if (file.has("/gravity_m_s2")) robot.gravity_m_s2 = file.vector("/gravity_m_s2");
  if (!file.has("/tool")) return;
  robot.tool_kg = file.number("/tool/mass_kg", 0.0, 100.0);
  robot.tool_center_m = file.vector("/tool/center_m");
}

void read_base(const JsonFile& file, RobotConfig& robot) {
  if (!file.has("/base")) return;
  BaseConfig base;
  base.limit_rad = kRadPerDeg * file.number("/base/limit_deg", 0.1, kMostBase_deg);
  base.slide_m_per_rad = file.number("/base/slide_m_per_deg", 1e-6, 1.0) / kRadPerDeg;
  base.roll_radius_m = file.number("/base/roll_radius_m", 0.001, 1.0);
  base.mass_kg = file.number("/base/mass_kg", 0.001, 1000.0);
  robot.base = base;
}

// The base as a segment: it limits two angles and ends where the first disc is.
SegmentConfig segment_of(const BaseConfig& base, double face_offset_m) {
  SegmentConfig segment;
  segment.theta_limit_rad = base.limit_rad;
  segment.face_offset_m = face_offset_m;
  return segment;
}

void read_segments(const JsonFile& file, RobotConfig& robot) {
  const std::size_t count = file.size("/segments"), most = kMaxSegments - robot.first_bending();
  if (count < 1 || count > most)
    file.fail("/segments", "has " + std::to_string(count) + " entries, allowed is 1 to " + std::to_string(most) +
                               (robot.base ? " beside a base" : ""));
  for (std::size_t m = 0; m < count; ++m) {
    SegmentConfig segment;
    segment.modules = file.integer(at("/segments", m) + "/modules", 1, 16);
    segment.module_length_m = file.number(at("/segments", m) + "/module_length_m", 0.001, 1.0);
    segment.theta_limit_rad = kRadPerDeg * file.number(at("/segments", m) + "/theta_limit_deg", 0.1, 45.0);
    read_module(file, at("/segments", m), segment);
    const std::string phases = at("/cables/phase_deg", m);
    const std::size_t cables = file.size(phases);
    if (cables < 3 || cables > 5) file.fail(phases, "has " + std::to_string(cables) + " cables, allowed is 3 to 5");
    for (const double phase : file.numbers(phases, cables, -360.0, 360.0))
      segment.cable_phase_rad.push_back(kRadPerDeg * phase);
    segment.hole_radius_m = number_of_segment(file, "/cables/hole_radius_m", m, 0.0002, 0.5);
    segment.face_offset_m = number_of_segment(file, "/cables/face_offset_m", m, 0.0, 0.5);
    robot.segments.push_back(segment);
  }
  if (robot.base)
    robot.segments.insert(robot.segments.begin(), segment_of(*robot.base, robot.segments.front().face_offset_m));
}

void read_mechanics(const JsonFile& file, RobotConfig& robot) {
  read_weight(file, robot);
  robot.module_radius_m = file.number("/module/radius_m", 0.0005, 0.5);
  robot.viscous_Nms_per_rad = file.number("/joint/viscous_Nms_per_rad", 0.0, 100.0);
  robot.cable_EA_N = file.number("/cables/EA_N", 1e2, 1e8);
  robot.plan_tension_N = file.number("/tension/plan_N", 1e-3, 1e6);
  robot.lead_m = file.number("/cables/lead_m", 0.01, 10.0);
  for (const auto& name : file.keys("/cables/friction_mu"))
    robot.friction_mu[name] = file.number("/cables/friction_mu/" + name, 0.0, 0.5);
}

void read_drives(const JsonFile& file, RobotConfig& robot) {
  robot.drum_radius_m = file.number("/drives/drum_radius_m", 0.001, 0.5);
  robot.counts_per_turn = static_cast<std::uint32_t>(file.integer("/drives/counts_per_turn", 256, 1 << 24));
  robot.gear = file.number("/drives/gear", 0.01, 1000.0);
  robot.servo_time_constant_s = file.number("/drives/servo_time_constant_s", 0.001, 1.0);
  robot.rated_torque_Nm = file.number("/drives/rated_torque_Nm", 0.01, 4000.0);
  robot.vendor = static_cast<std::uint32_t>(file.number("/drives/identity/vendor", 0.0, 4294967295.0));
  robot.product = static_cast<std::uint32_t>(file.number("/drives/identity/product", 0.0, 4294967295.0));
  robot.revision = static_cast<std::uint32_t>(file.number("/drives/identity/revision", 0.0, 4294967295.0));
  std::size_t drives = robot.base_drives();
  for (const auto& segment : robot.segments) drives += segment.cable_phase_rad.size();
  if (drives > kMaxCables)
    file.fail("/cables/phase_deg",
              "asks for " + std::to_string(drives) + " drives, allowed is 1 to " + std::to_string(kMaxCables));
  const auto direction = file.numbers("/drives/direction", drives, -1.0, 1.0);
  const auto zero = file.numbers("/drives/zero_counts", drives, -1e9, 1e9);
  for (std::size_t i = 0; i < drives; ++i) {
    if (direction[i] == 0.0) file.fail(at("/drives/direction", i), "is 0; allowed is -1 or 1");
    robot.drives.push_back({direction[i] > 0.0 ? 1 : -1, zero[i], static_cast<std::uint32_t>(kFirstSerial + i)});
    if (file.has("/drives/serials"))
      robot.drives[i].serial = static_cast<std::uint32_t>(file.number(at("/drives/serials", i), 1.0, 4294967295.0));
  }
  if (file.has("/limits/cable_speed_m_s"))
    robot.fastest_counts_per_s = file.number("/limits/cable_speed_m_s", 0.0, 10.0) / robot.metres_per_count();
}

void read_named_poses(const JsonFile& file, RobotConfig& robot) {
  constexpr double kMostBend_deg = 90.0;
  const double base_deg = robot.base ? file.number("/base/limit_deg", 0.1, kMostBase_deg) : 0.0;
  const double max_deg = std::max(base_deg, kMostBend_deg);
  for (const auto& name : file.keys("/named_poses_deg")) {
    const std::string field = "/named_poses_deg/" + name;
    auto pose = file.numbers(field, robot.theta_count(), -max_deg, max_deg);
    for (std::size_t i = 0; i < pose.size(); ++i) {
      const double limit_deg = i < robot.base_drives() ? base_deg : kMostBend_deg;
      pose[i] = kRadPerDeg * file.number(at(field, i), -limit_deg, limit_deg);
    }
    robot.named_poses_rad[name] = pose;
  }
}

}  // namespace

double RobotConfig::metres_per_count() const {
  return 2.0 * std::numbers::pi * drum_radius_m / (counts_per_turn * gear);
}

double RobotConfig::path_at_zero_m(std::size_t segment) const {
  double path = 0.0;
  for (std::size_t j = 0; j <= segment; ++j) path += segments[j].modules * segments[j].module_length_m;
  return path - (segments[segment].module_length_m - (segments[0].face_offset_m + segments[segment].face_offset_m));
}

std::vector<double> RobotConfig::paths_at_zero_m() const {
  std::vector<double> paths;
  if (base)
    for (const double metres : base->metres_per_rad()) paths.push_back(metres * base->limit_rad);
  for (std::size_t m = first_bending(); m < segments.size(); ++m)
    paths.insert(paths.end(), segments[m].cable_phase_rad.size(), path_at_zero_m(m));
  return paths;
}

RobotConfig load_robot(const std::string& path) {
  const JsonFile file(path, "robot");
  RobotConfig robot;
  read_base(file, robot);
  read_segments(file, robot);
  read_mechanics(file, robot);
  read_drives(file, robot);
  read_named_poses(file, robot);
  return robot;
}

}  // namespace liana::bench
