#include "fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/model/config/theta_numbers.hpp"

namespace liana::closed_loop {

const config::RobotConfig& robot(const std::string& physics) {
  static std::map<std::string, config::RobotConfig> loaded;
  const auto found = loaded.find(physics);
  if (found != loaded.end()) return found->second;
  const config::BusesConfig buses = config::load_buses(CLOSED_LOOP_DATA "/buses.json");
  return loaded.emplace(physics, config::load_robot(CLOSED_LOOP_DATA "/robot.json", physics, buses)).first->second;
}

const cable::RobotParams& robot_table(const std::string& physics) { return robot(physics).table; }

namespace {

cable::ThetaVector pose_rad(const config::RobotConfig& robot, const std::string& name) {
  return config::theta_rad(robot.named_poses_deg.at(name));
}

const config::RobotConfig& lab() {
  static const config::RobotConfig loaded = config::load_robot(CLOSED_LOOP_DATA "/lab_1g.json", "nominal",
                                                               config::load_buses(CLOSED_LOOP_DATA "/buses.json"));
  return loaded;
}

}  // namespace

cable::RobotParams lab_table(const Vec3& gravity_m_s2) {
  cable::RobotParams table = lab().table;
  table.gravity_m_s2 = gravity_m_s2;
  return table;
}

const cable::RobotParams& feeder_table() {
  static const config::RobotConfig loaded = config::load_robot(
      CLOSED_LOOP_DATA "/feeder.json", "nominal", config::load_buses(CLOSED_LOOP_DATA "/feeder_buses.json"));
  return loaded.table;
}

cable::ThetaVector lab_pose_rad(const std::string& name) { return pose_rad(lab(), name); }
cable::ThetaVector named_pose_rad(const std::string& name) { return pose_rad(robot("nominal"), name); }

Pose tip_at(const std::string& pose_name) {
  return forward_kinematics(robot_table(), named_pose_rad(pose_name)).tip_in_base;
}

const config::SceneConfig& scene() {
  static const config::SceneConfig loaded = config::load_scene(CLOSED_LOOP_DATA "/scene.json");
  return loaded;
}

double largest_difference_deg(const cable::ThetaVector& a_rad, const cable::ThetaVector& b_rad) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a_rad.size(); ++i) largest = std::max(largest, std::fabs(a_rad[i] - b_rad[i]) / kDegree);
  return largest;
}

double distance_mm(const Vec3& a_m, const Vec3& b_m) { return 1000.0 * norm(subtract(a_m, b_m)); }

double minimum_jerk(double x) { return x * x * x * (10.0 - 15.0 * x + 6.0 * x * x); }

void measured(const std::string& what, double value, const std::string& unit) {
  std::printf("  measured: %s %.4g %s\n", what.c_str(), value, unit.c_str());
  std::string key = what;
  std::ranges::replace_if(
      key, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  ::testing::Test::RecordProperty(key, std::to_string(value) + " " + unit);
}

}  // namespace liana::closed_loop
