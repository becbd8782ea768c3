#include "hil/arm/true_parameters.hpp"

#include <cmath>
#include <stdexcept>

#include "hil/config/start_angles.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

namespace {

template <class Map>
std::string names_of(const Map& map) {
  std::string names;
  for (const auto& [name, value] : map) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

TrueParameters table_parameters(const RobotConfig& robot, const std::string& physics) {
  const auto mu = robot.friction_mu.find(physics);
  if (mu == robot.friction_mu.end())
    throw std::runtime_error("--physics: \"" + physics + "\" is not in the robot's friction_mu; allowed are " +
                             names_of(robot.friction_mu));
  TrueParameters parameters;
  parameters.EA_N = robot.cable_EA_N;
  parameters.mu = mu->second;
  parameters.torque_gain.fill(1.0);
  return parameters;
}

TrueParameters spread_parameters(const RobotConfig& robot, const std::string& physics, std::uint64_t seed) {
  TrueParameters parameters = table_parameters(robot, physics);
  Random arm(seed, "arm parameters");
  parameters.EA_N *= arm.uniform(0.95, 1.05);
  parameters.mu *= arm.uniform(0.8, 1.2);
  parameters.hole_radius_error_m = arm.uniform(-0.02e-3, 0.02e-3);
  Random zeros(seed, "cable zeros");
  Random gains(seed, "torque gains");
  for (std::size_t c = robot.base_drives(); c < robot.drive_count(); ++c) {
    parameters.zero_offset_m[c] = zeros.uniform(-0.05e-3, 0.05e-3);
    parameters.torque_gain[c] = gains.uniform(0.99, 1.01);
  }
  return parameters;
}

RobotConfig spread_load(const RobotConfig& robot, std::uint64_t seed) {
  RobotConfig built = robot;
  bool has_springs = false;
  for (const SegmentConfig& segment : robot.segments) has_springs |= segment.joint_stiffness_Nm_rad != 0.0;
  if (norm(robot.gravity_m_s2) == 0.0 && !has_springs) return built;
  constexpr double kMass = 0.05, kCenter_m = 0.005, kStiffness = 0.1, kTilt_rad = 1.0 / kDegPerRad;
  Random load(seed, "load");
  for (SegmentConfig& segment : built.segments) {
    if (segment.modules == 0) continue;  // a base
    segment.module_mass_kg *= 1.0 + load.uniform(-kMass, kMass);
    segment.module_center += load.uniform(-kCenter_m, kCenter_m) / segment.module_length_m;
    segment.joint_stiffness_Nm_rad *= 1.0 + load.uniform(-kStiffness, kStiffness);
  }
  built.tool_kg *= 1.0 + load.uniform(-kMass, kMass);
  Vec3& center_m = built.tool_center_m;
  if (built.tool_kg != 0.0)
    center_m = center_m + Vec3{load.uniform(-kCenter_m, kCenter_m), load.uniform(-kCenter_m, kCenter_m),
                               load.uniform(-kCenter_m, kCenter_m)};
  const double gravity = norm(robot.gravity_m_s2), tilt_rad = load.uniform(0.0, kTilt_rad);
  const Vec3 aside = cross(robot.gravity_m_s2, gaussian(load, 1.0));
  if (norm(aside) != 0.0)
    built.gravity_m_s2 = std::cos(tilt_rad) * robot.gravity_m_s2 + (std::sin(tilt_rad) * gravity / norm(aside)) * aside;
  return built;
}

Theta start_pose(const RobotConfig& robot, const std::string& name, double spread_rad, std::uint64_t seed) {
  const std::vector<double> pose_rad = start_angles_rad(robot.named_poses_rad, robot.theta_count(), name);
  Random offsets(seed, "start pose");
  Theta theta{};
  for (std::size_t i = 0; i < robot.theta_count(); ++i) {
    const double offset_rad = offsets.uniform(-spread_rad, spread_rad),
                 limit_rad = robot.segments[i / 2].theta_limit_rad;
    const bool is_beyond = std::fabs(pose_rad[i] + offset_rad) > limit_rad;  // no arm lies beyond its stop
    theta[i] = pose_rad[i] + (is_beyond ? -offset_rad : offset_rad);
  }
  return theta;
}

}  // namespace liana::bench
