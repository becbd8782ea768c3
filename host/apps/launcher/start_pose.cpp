#include "host/apps/launcher/start_pose.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/options/nearest.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/robot_parts.hpp"
#include "host/model/simulation/serial_simulation.hpp"
#include "host/planning/planner/check/plan_check.hpp"

namespace liana::launcher {
namespace {

using Poses = std::map<std::string, std::vector<double>>;

// What is common to both kinds of arm: its poses, which of them a run begins with, and what its angles may be.
struct Choice {
  const std::string& robot;
  const Poses& poses;
  const std::string& of_table;
  std::vector<config::Range> range_deg;  // of every angle
};

[[noreturn]] void refuse(const Choice& choice, const std::string& given, const std::string& allowed) {
  throw BadInput("--start-pose: '" + given + "': allowed for robot " + choice.robot + ": " + allowed);
}

std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    double number = 0.0;
    const char* end = text.data() + comma;
    const auto [stopped, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stopped != end) return std::nullopt;
    numbers.push_back(number);
    if (comma == text.size()) return numbers;
    text.remove_prefix(comma + 1);
  }
}

// Least bent angle and the sum of all.
std::pair<double, double> bend_of(const std::vector<double>& angles_deg) {
  std::pair<double, double> bend{std::fabs(angles_deg.front()), 0.0};
  for (const double angle_deg : angles_deg) {
    bend.first = std::min(bend.first, std::fabs(angle_deg));
    bend.second += std::fabs(angle_deg);
  }
  return bend;
}

std::string default_of(const Choice& choice) {
  if (!choice.of_table.empty()) return choice.of_table;
  for (const char* name : {"prepare", "zero"})
    if (choice.poses.contains(name)) return name;
  return choice.poses.begin()->first;
}

StartPose chosen(const Choice& choice, const std::string& given) {
  const std::string text = given.empty() ? default_of(choice) : given;
  if (const auto pose = choice.poses.find(text); pose != choice.poses.end()) return {text, pose->second};
  const auto numbers = numbers_in(text);
  const std::size_t count = choice.range_deg.size();
  if (!numbers || numbers->size() != count)
    refuse(choice, text,
           options::allowed_names(text, options::names_of(choice.poses),
                                  ", or its " + std::to_string(count) + " angles in degrees"));
  for (std::size_t i = 0; i < count; ++i) {
    if (choice.range_deg[i].contains((*numbers)[i])) continue;
    refuse(choice, text, "angle " + std::to_string(i + 1) + " in " + choice.range_deg[i].text() + " deg");
  }
  return {text, *numbers};
}

// The independent check of one pose.
planner::PlanCheck check_of(const config::RobotConfig& robot, const config::SceneConfig& scene,
                            const std::vector<double>& angles_deg) {
  cable::ThetaVector theta_rad{};
  for (std::size_t k = 0; k < angles_deg.size(); ++k) theta_rad[k] = kDegree * angles_deg[k];
  return planner::check_plan(robot, scene, {theta_rad}, planner::plain_tip(robot.table, theta_rad));
}

std::string stands_inside(const std::string& link, double distance_m, const std::string& other) {
  char depth[32];
  std::snprintf(depth, sizeof depth, "%.1f", -1000.0 * distance_m);
  return link + " stands " + depth + " mm inside " + other;
}

// The distances of a serial arm at these angles [deg].
simulation::Distances standing(simulation::SerialSimulation& simulation, const std::vector<double>& angles_deg) {
  serial::JointVector joint_rad{};
  for (std::size_t i = 0; i < angles_deg.size(); ++i) joint_rad[i] = kDegree * angles_deg[i];
  const std::optional<config::ScenePayload>& payload = simulation.scene().payload;
  return simulation.run(joint_rad, {1.0, {joint_rad, joint_rad}}, payload && payload->on_arm).distances;
}

void refuse_inside(const std::string& inside, const config::SceneConfig& scene, const StartPose& start) {
  if (inside.empty()) return;
  throw BadInput("--scene: '" + scene.name + "': at the start pose " + start.text + " " + inside +
                 "; move the body, or give another --start-pose");
}

}  // namespace

StartPose start_pose_of(const config::RobotConfig& robot, const std::string& given) {
  Choice choice{robot.name, robot.named_poses_deg, robot.start_pose, {}};
  for (std::size_t k = 0; k < static_cast<std::size_t>(robot.table.theta_count()); ++k) {
    const double limit_deg = config::rounded_deg(robot.table.segment[k / 2].theta_limit_rad);
    choice.range_deg.push_back({-limit_deg, limit_deg});
  }
  return chosen(choice, given);
}

StartPose start_pose_of(const config::SerialRobotConfig& robot, const std::string& given) {
  Choice choice{robot.name, robot.named_poses_deg, robot.start_pose, {}};
  for (std::size_t i = 0; i < robot.table.joints(); ++i)
    choice.range_deg.push_back(
        {config::rounded_deg(robot.table.joint[i].low_rad), config::rounded_deg(robot.table.joint[i].high_rad)});
  return chosen(choice, given);
}

std::string bent_pose(const std::string& robot) {
  const std::string name = robot.empty() ? kDefaultRobot : robot;
  const std::optional<config::SerialRobotConfig> serial = serial_robot_for_kinematics(name);
  const Poses poses = serial ? serial->named_poses_deg : robot_for_kinematics(name).named_poses_deg;
  const auto most = std::max_element(
      poses.begin(), poses.end(), [](const auto& a, const auto& b) { return bend_of(a.second) < bend_of(b.second); });
  if (bend_of(most->second).second > 0.0) return most->first;
  throw BadInput("--robot: '" + name + "': its named poses are all straight, and the tip of a straight arm can go " +
                 "nowhere: add a bent one to named_poses_deg");
}

Json nearest_body(const config::RobotConfig& robot, const config::SceneConfig& scene,
                  const std::vector<double>& angles_deg) {
  const planner::PlanCheck check = check_of(robot, scene, angles_deg);
  return {{"body", check.nearest}, {"link", check.nearest_link}};
}

std::string inside_body(const config::RobotConfig& robot, const config::SceneConfig& scene,
                        const std::vector<double>& angles_deg) {
  const planner::PlanCheck check = check_of(robot, scene, angles_deg);
  if (check.min_clearance_m > 0.0) return "";
  char text[64];
  std::snprintf(text, sizeof text, "link %d stands %.1f mm inside body ", check.nearest_link,
                -1000.0 * check.min_clearance_m);
  return text + check.nearest;
}

std::string inside_body(const config::SerialRobotConfig& robot, const config::SceneConfig& scene,
                        const std::vector<double>& angles_deg) {
  simulation::SerialSimulation simulation(checked([&] { return simulation::serial_model(robot, scene); }), scene);
  const simulation::Nearest near = standing(simulation, angles_deg).scene;
  if (near.link < 0 || near.distance_m > 0.0) return "";
  return stands_inside(simulation.contact().link_name(near.link), near.distance_m,
                       "body " + clearance::obstacle_name(scene, near.other));
}

std::string inside_itself(const config::SerialRobotConfig& robot, const std::vector<double>& angles_deg) {
  simulation::SerialSimulation simulation(simulation::serial_model(robot), {});
  const simulation::Nearest near = standing(simulation, angles_deg).self;
  if (near.distance_m > 0.0) return "";
  return stands_inside(simulation.contact().link_name(near.link), near.distance_m,
                       simulation.contact().link_name(near.other));
}

void check_start_is_free(const config::RobotConfig& robot, const config::SceneConfig& scene, const StartPose& start) {
  refuse_inside(inside_body(robot, scene, start.angles_deg), scene, start);
}

void check_start_is_free(const config::SerialRobotConfig& robot, const config::SceneConfig& scene,
                         const StartPose& start) {
  const std::string folded = inside_itself(robot, start.angles_deg);
  if (!folded.empty()) throw BadInput("--start-pose: '" + start.text + "': " + folded + "; give another");
  refuse_inside(inside_body(robot, scene, start.angles_deg), scene, start);
}

}  // namespace liana::launcher
