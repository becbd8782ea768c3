// Geometry, motion limits and named poses of a robot table.
#include <algorithm>
#include <cmath>

#include "firmware_like/operator_input/tip_filter.hpp"
#include "host/model/config/robot_parts.hpp"

namespace liana::config {
namespace {

constexpr double kLongestTipLag_s = 5.0;

constexpr Range kModuleMass{0.000001, 100};
constexpr double kHeaviest_m_s2 = 30.0;
constexpr double kRollMost_deg = 170.0;  // half a turn is the same either way

bool has(const Field& table, const char* key) { return table.json().contains(key); }

double number_or(const Field& table, const char* key, const Range& range, double otherwise) {
  return has(table, key) ? table.at(key).number(range) : otherwise;
}

void read_rest(const Field& table, const char* key, cable::SegmentParams& segment) {
  if (!has(table, key)) return;
  const auto rest_deg = table.at(key).numbers<2>({-45, 45});
  segment.joint_rest_rad = {rest_deg[0] * kDegree, rest_deg[1] * kDegree};
}

// What every segment has that does not say otherwise.
cable::SegmentParams read_module(const Field& module, const Field& joint) {
  module.only({"mass_kg", "radius_m", "center"});
  joint.only({"viscous_Nms_per_rad", "stiffness_Nm_per_rad", "rest_deg"});
  cable::SegmentParams out;
  out.module_mass_kg = module.at("mass_kg").number(kModuleMass);
  out.module_center = number_or(module, "center", {0, 1}, out.module_center);
  out.joint_stiffness_Nm_rad = number_or(joint, "stiffness_Nm_per_rad", {0, 1e4}, 0.0);
  read_rest(joint, "rest_deg", out);
  return out;
}

// Of segment `m`: a number is that of all segments, a list has one for each.
double number_of_segment(const Field& field, std::size_t m, std::size_t count, const Range& range) {
  if (!field.json().is_array()) return field.number(range);
  field.size(count, count, "give one number, or one for each segment");
  return field.element(m).number(range);
}

void read_segment(const Field& field, cable::SegmentParams& segment) {
  field.only({"modules", "module_length_m", "theta_limit_deg", "module_mass_kg", "module_center",
              "joint_stiffness_Nm_per_rad", "joint_rest_deg"});
  segment.module_mass_kg = number_or(field, "module_mass_kg", kModuleMass, segment.module_mass_kg);
  segment.module_center = number_or(field, "module_center", {0, 1}, segment.module_center);
  segment.joint_stiffness_Nm_rad =
      number_or(field, "joint_stiffness_Nm_per_rad", {0, 1e4}, segment.joint_stiffness_Nm_rad);
  read_rest(field, "joint_rest_deg", segment);
  segment.modules = static_cast<std::int32_t>(field.at("modules").integer(1, cable::kMaxModules));
  segment.module_length_m = field.at("module_length_m").number({0.001, 1});
  segment.theta_limit_rad = field.at("theta_limit_deg").number({0.1, 45}) * kDegree;
}

void read_weight(const Field& table, cable::RobotParams& robot) {
  if (has(table, "gravity_m_s2"))
    robot.gravity_m_s2 = table.at("gravity_m_s2").numbers<3>({-kHeaviest_m_s2, kHeaviest_m_s2});
  if (!has(table, "tool")) return;
  const Field tool = table.at("tool");
  tool.only({"mass_kg", "center_m"});
  robot.tool = {tool.at("mass_kg").number({0, cable::kMaxTipLoad_kg}),
                tool.at("center_m").numbers<3>({-cable::kMaxTipLoad_m, cable::kMaxTipLoad_m})};
}

// What stands below the first segment, where the table has one: segment 1 of the core.
void read_base(const Field& field, cable::RobotParams& robot) {
  field.only({"limit_deg", "slide_m_per_deg", "roll_radius_m", "mass_kg"});
  cable::SegmentParams& base = robot.segment[0];
  base.cables = 2;
  base.theta_limit_rad = field.at("limit_deg").number({0.1, kRollMost_deg}) * kDegree;
  base.slide_m_rad = field.at("slide_m_per_deg").number({1e-5, 0.1}) / kDegree;
  base.roll_radius_m = field.at("roll_radius_m").number({0.001, 1});
  base.module_mass_kg = field.at("mass_kg").number({0.001, 1000});
}

// Cables can only pull: no half circle may be without one.
bool surround(std::vector<double> phases_deg) {
  for (double& phase : phases_deg) phase -= 360.0 * std::floor(phase / 360.0);
  std::sort(phases_deg.begin(), phases_deg.end());
  double widest = phases_deg.front() + 360.0 - phases_deg.back();
  for (std::size_t i = 1; i < phases_deg.size(); ++i) widest = std::max(widest, phases_deg[i] - phases_deg[i - 1]);
  return widest < 179.0;
}

void read_phases(const Field& field, cable::SegmentParams& segment) {
  const std::size_t count = field.size(3, cable::kMaxSegmentCables, "a segment needs 3 to 5 cables");
  std::vector<double> phases_deg;
  for (std::size_t c = 0; c < count; ++c) {
    phases_deg.push_back(field.element(c).number({-360, 360}));
    segment.cable_phase_rad[c] = phases_deg.back() * kDegree;
  }
  if (!surround(phases_deg))
    field.refuse("phases with less than 179 deg between neighbours",
                 "spread the cables around the link, they can only pull");
  segment.cables = static_cast<std::int32_t>(count);
}

}  // namespace

void read_arm(const Field& table, RobotConfig& out) {
  cable::RobotParams& robot = out.table;
  const Field module = table.at("module");
  out.module_radius_m = module.at("radius_m").number({0.0005, 0.5});
  const cable::SegmentParams each = read_module(module, table.at("joint"));
  read_weight(table, robot);
  out.joint_viscous_Nms_per_rad = table.at("joint").at("viscous_Nms_per_rad").number({0, 100});

  const std::size_t base = has(table, "base") ? 1 : 0;
  if (base != 0) read_base(table.at("base"), robot);
  const Field segments = table.at("segments");
  const std::size_t count =
      segments.size(1, cable::kMaxSegments - base,
                    base == 0 ? "this build holds at most 8 segments (kMaxSegments)"
                              : "this build holds at most 8 segments (kMaxSegments), of which the base is one");
  robot.segment_count = static_cast<std::int32_t>(base + count);
  const Field phases = table.at("cables").at("phase_deg");
  phases.size(count, count, "give one list of phases per segment");
  double shortest_m = 1.0;
  for (std::size_t m = 0; m < count; ++m) {
    cable::SegmentParams& segment = robot.segment[base + m];
    segment = each;
    read_segment(segments.element(m), segment);
    read_phases(phases.element(m), segment);
    shortest_m = std::min(shortest_m, segment.module_length_m);
  }
  if (robot.cable_count() > cable::kMaxCables)
    phases.refuse("at most 32 cables", "this build holds at most 32 drives (kMaxCables)");
  const Field radius = table.at("cables").at("hole_radius_m"), offset = table.at("cables").at("face_offset_m");
  for (std::size_t m = 0; m < count; ++m) {
    cable::SegmentParams& segment = robot.segment[base + m];
    segment.hole_radius_m = number_of_segment(radius, m, count, {0.0002, out.module_radius_m});
    segment.face_offset_m = number_of_segment(offset, m, count, {0.00001, 0.49 * shortest_m});
  }
}

// A shorter lag than it takes to brake would have the tip pass a target that stops.
double read_tip_lag_s(const Field& field, const cable::MotionLimits& limits) {
  const double linear_s = min_lag_s({limits.tip_speed_m_s, limits.tip_accel_m_s2, limits.tip_jerk_m_s3});
  const double angular_s =
      min_lag_s({limits.tip_rate_rad_s, limits.tip_angular_accel_rad_s2, limits.tip_angular_jerk_rad_s3});
  const Range range{std::ceil(1000.0 * std::max(linear_s, angular_s) - 1e-6) / 1000.0, kLongestTipLag_s};
  const double lag_s = field.number({0, kLongestTipLag_s, true});
  if (!range.contains(lag_s))
    field.refuse(range.text(), linear_s >= angular_s ? "raise tip_accel_m_s2 and tip_jerk_m_s3 for a shorter lag"
                                                     : "raise tip_angular_accel_deg_s2 and tip_angular_jerk_deg_s3 for "
                                                       "a shorter lag");
  return lag_s;
}

void read_limits(const Field& field, cable::MotionLimits& limits) {
  field.only({"theta_rate_deg_s", "theta_accel_deg_s2", "tip_speed_m_s", "tip_speed_slit_m_s", "tip_accel_m_s2",
              "tip_jerk_m_s3", "tip_rate_deg_s", "tip_angular_accel_deg_s2", "tip_angular_jerk_deg_s3",
              "cable_speed_m_s", "tip_lag_s"});
  limits.theta_rate_rad_s = field.at("theta_rate_deg_s").number({0.001, 90}) * kDegree;
  limits.theta_accel_rad_s2 = field.at("theta_accel_deg_s2").number({0.001, 1000}) * kDegree;
  limits.tip_speed_m_s = field.at("tip_speed_m_s").number({0.000001, 2});
  limits.tip_speed_slit_m_s = field.at("tip_speed_slit_m_s").number({0.000001, limits.tip_speed_m_s});
  limits.tip_accel_m_s2 = field.at("tip_accel_m_s2").number({0.000001, 50});
  limits.tip_jerk_m_s3 = field.at("tip_jerk_m_s3").number({0.001, 1000});
  limits.tip_rate_rad_s = field.at("tip_rate_deg_s").number({0.001, 360}) * kDegree;
  limits.tip_angular_accel_rad_s2 = field.at("tip_angular_accel_deg_s2").number({0.001, 10000}) * kDegree;
  limits.tip_angular_jerk_rad_s3 = field.at("tip_angular_jerk_deg_s3").number({0.001, 100000}) * kDegree;
  limits.cable_speed_m_s = field.at("cable_speed_m_s").number({0.0001, 1});
  if (field.json().contains("tip_lag_s")) limits.tip_lag_s = read_tip_lag_s(field.at("tip_lag_s"), limits);
}

void read_named_poses(const Field& field, RobotConfig& out) {
  field.at("zero");
  const auto angles = static_cast<std::size_t>(out.table.theta_count());
  for (const auto& [name, list] : field.json().items()) {
    const Field pose = field.at(name);
    pose.size(angles, angles, "give pitch and yaw of every segment, in degrees, before them slide and roll of a base");
    std::vector<double> theta_deg;
    for (std::size_t i = 0; i < angles; ++i) {
      const double limit_deg = rounded_deg(out.table.segment[i / 2].theta_limit_rad);
      theta_deg.push_back(pose.element(i).number({-limit_deg, limit_deg}));
    }
    out.named_poses_deg.emplace(name, theta_deg);
  }
}

namespace {

std::vector<std::string> names_of(const std::map<std::string, std::vector<double>>& named_poses_deg) {
  std::vector<std::string> names;
  for (const auto& [name, angles_deg] : named_poses_deg) names.push_back(name);
  return names;
}

}  // namespace

std::string read_start_pose(const Field& table, const std::map<std::string, std::vector<double>>& named_poses_deg) {
  return table.json().contains("start_pose") ? table.at("start_pose").choice(names_of(named_poses_deg)) : "";
}

std::vector<std::string> read_jig_poses(const Field& table,
                                        const std::map<std::string, std::vector<double>>& named_poses_deg) {
  std::vector<std::string> poses;
  if (!table.json().contains("jig_poses")) return poses;
  const Field list = table.at("jig_poses");
  list.size(2, named_poses_deg.size(), "name two or more poses for which there are jigs");
  for (std::size_t i = 0; i < list.json().size(); ++i) {
    const std::string name = list.element(i).choice(names_of(named_poses_deg));
    if (std::find(poses.begin(), poses.end(), name) != poses.end())
      list.element(i).refuse("each pose once", "leave it out");
    poses.push_back(name);
  }
  return poses;
}

}  // namespace liana::config
