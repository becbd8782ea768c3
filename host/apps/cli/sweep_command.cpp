#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/planning/self_motion/picture.hpp"
#include "host/planning/self_motion/self_motion.hpp"

namespace liana::cli {
namespace {

constexpr std::int32_t kJoints = 7;

config::SerialRobotConfig sweepable(const std::string& name) {
  const auto robot = launcher::serial_robot_for_kinematics(name);
  if (!robot) throw launcher::BadInput("--robot: " + name + ": has cables; allowed a serial arm, as macro or micro");
  const std::string is = "--robot: " + name + ": ";
  if (robot->table.joint_count != kJoints)
    throw launcher::BadInput(is + std::to_string(robot->table.joint_count) +
                             " joints: allowed 7, one more than a pose needs; no other arm has one self-motion");
  if (robot->stiffness_Nm_rad.empty())
    throw launcher::BadInput(is + "joints say no stiffness_Nm_per_rad; add it to every joint of the table");
  return *robot;
}

serial::JointVector start_of(const config::SerialRobotConfig& robot, const std::string& given) {
  std::string name = !given.empty() ? given : robot.start_pose;
  if (name.empty()) name = robot.named_poses_deg.contains("prepare") ? "prepare" : robot.named_poses_deg.begin()->first;
  return parse_pose_deg("--from-deg", name, robot);
}

Json configuration_json(const self_motion::Configuration& at) {
  Json theta_deg = Json::array();
  for (std::size_t i = 0; i < kJoints; ++i) theta_deg.push_back(at.joint_rad[i] / kDegree);
  return {{"arm_angle_deg", at.arm_angle_rad / kDegree},
          {"theta_deg", theta_deg},
          {"tip_drift_m", at.tip_drift_m},
          {"tip_turn_deg", at.tip_turn_rad / kDegree},
          {"deflection_m_per_N", at.deflection_m_per_N},
          {"least_singular_value", at.least_singular_value},
          {"within_ranges", at.within_ranges}};
}

double max_drift_m(const self_motion::SelfMotion& motion) {
  double most = 0.0;
  for (const self_motion::Configuration& at : motion.way) most = std::max(most, at.tip_drift_m);
  return most;
}

double turned_deg(const self_motion::SelfMotion& motion) {
  double low = 0.0, high = 0.0;
  for (const self_motion::Configuration& at : motion.way) {
    low = std::min(low, at.arm_angle_rad);
    high = std::max(high, at.arm_angle_rad);
  }
  return (high - low) / kDegree;
}

// One row for each degree of arm angle and the ends: more than a picture shows.
Json rows_json(const self_motion::SelfMotion& motion) {
  Json rows = Json::array();
  double last = -1e9;
  for (const self_motion::Configuration& at : motion.way) {
    const double degree = std::round(at.arm_angle_rad / kDegree);
    if (degree == last && &at != &motion.way.back()) continue;
    last = degree;
    rows.push_back(configuration_json(at));
  }
  return rows;
}

Json answer_of(const std::string& robot, const self_motion::SelfMotion& motion) {
  return {{"robot", robot},
          {"closed", motion.closed},
          {"arm_angle_deg", turned_deg(motion)},
          {"configurations", motion.way.size()},
          {"tip_drift_m", max_drift_m(motion)},
          {"stiffest", configuration_json(motion.way[self_motion::stiffest(motion)])},
          {"softest", configuration_json(motion.way[self_motion::softest(motion)])},
          {"way", rows_json(motion)}};
}

void print_configuration(const char* name, const self_motion::Configuration& at) {
  const Vec3& gives = at.deflection_m_per_N;
  std::printf("  %-9s %8.2f %8.3f %8.3f %8.3f  %-4s", name, at.arm_angle_rad / kDegree, 1e3 * gives[0], 1e3 * gives[1],
              1e3 * gives[2], at.within_ranges ? "yes" : "no");
  for (std::size_t i = 0; i < kJoints; ++i) std::printf(" %.1f", at.joint_rad[i] / kDegree);
  std::printf("\n");
}

void print_answer(const self_motion::SelfMotion& motion) {
  std::printf("%s over %.1f deg of arm angle in %zu configurations; the tip drifts by %.1e m at most\n",
              motion.closed ? "closed" : "not closed", turned_deg(motion), motion.way.size(), max_drift_m(motion));
  std::printf("under 1 N along z: angle deg, x y z of the tip mm, within ranges, theta deg\n");
  print_configuration("start", motion.way.front());
  print_configuration("stiffest", motion.way[self_motion::stiffest(motion)]);
  print_configuration("softest", motion.way[self_motion::softest(motion)]);
}

}  // namespace

int sweep_command(const SweepOptions& options) {
  if (!options.svg_file.empty()) launcher::check_output("--svg", options.svg_file);
  const config::SerialRobotConfig robot = sweepable(options.robot);
  serial::JointVector stiffness_Nm_rad{};
  std::copy(robot.stiffness_Nm_rad.begin(), robot.stiffness_Nm_rad.end(), stiffness_Nm_rad.begin());
  const serial::JointVector start_rad = start_of(robot, options.from_deg);
  const self_motion::SelfMotion motion = self_motion::self_motion(robot.table, stiffness_Nm_rad, start_rad);
  if (!options.svg_file.empty()) launcher::write_output(options.svg_file, self_motion::picture_of(robot.name, motion));
  if (options.json) {
    std::puts(answer_of(robot.name, motion).dump().c_str());
  } else {
    print_answer(motion);
  }
  if (motion.closed) return launcher::kExitOk;
  std::fprintf(stderr, "liana: sweep: %s; start from another pose (--from-deg)\n",
               motion.way.size() < self_motion::kMaxSteps
                   ? "the arm is singular there: its self-motion has no one direction"
                   : "the self-motion did not come back to its start");
  return launcher::kExitFailure;
}

}  // namespace liana::cli
