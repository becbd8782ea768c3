#include "host/apps/cli/reach_along_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/pose_json.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/theta_numbers.hpp"
#include "host/planning/workspace/path.hpp"
#include "host/planning/workspace/picture.hpp"

namespace liana::cli {
namespace {

std::string number_list(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ",") + Json(number).dump();
  return text;
}

// The waypoints of a file: what `liana plan --json` prints, or a JSON object with waypoints_deg (rows of joint angles,
// degrees).
std::vector<cable::ThetaVector> read_waypoints(const std::string& path, const cable::RobotParams& robot) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable))
    throw launcher::BadInput("--path: " + path + ": cannot be read; give an existing JSON file with waypoints_deg");
  const std::string text = launcher::checked([&] { return config::read_text_file(path); });
  const Json document = launcher::checked(
      [&] { return config::parse_json(text, "--path: " + path, "give a JSON object with waypoints_deg"); });
  const Json rows = document.is_object() ? document.value("waypoints_deg", Json()) : Json();
  if (!rows.is_array() || rows.empty() || rows.size() > workspace::kMaxWaypoints) {
    throw launcher::BadInput("--path: " + path + ": waypoints_deg: allowed: a JSON object with 1 to " +
                             std::to_string(workspace::kMaxWaypoints) + " rows of joint angles under this key");
  }
  std::vector<cable::ThetaVector> waypoints;
  for (const Json& row : rows) {
    const std::string name = "--path: " + path + ": waypoints_deg row " + std::to_string(waypoints.size() + 1);
    const auto is_number = [](const Json& value) { return value.is_number(); };
    if (!row.is_array() || !std::all_of(row.begin(), row.end(), is_number))
      throw launcher::BadInput(name + ": allowed: an array of numbers");
    waypoints.push_back(parse_theta_deg(name, number_list(row.get<std::vector<double>>()), robot));
  }
  return waypoints;
}

Json point_json(const workspace::PathPoint& point, const cable::RobotParams& robot) {
  const double condition = workspace::condition_number(point);
  return {{"way", point.way},
          {"theta_deg", degrees_json(point.theta_rad, robot.theta_count())},
          {"tip_m", point.tip_in_base_m},
          {"least_singular_value", point.least_singular_value},
          {"condition", std::isfinite(condition) ? Json(condition) : Json()},
          {"limit_margin_deg", point.limit_margin_rad / kDegree},
          {"nearest_theta", point.nearest_theta}};
}

Json path_json(const workspace::PathStatus& report, std::uint32_t held_mask, const config::RobotConfig& robot) {
  Json points = Json::array();
  for (const workspace::PathPoint& point : report.points) points.push_back(point_json(point, robot.table));
  return {{"robot", robot.name},
          {"held_theta", config::theta_numbers(held_mask)},
          {"joint_travel_deg", report.joint_travel_rad / kDegree},
          {"waypoint_way", report.waypoint_way},
          {"worst_conditioned", point_json(report.points[report.worst_conditioned], robot.table)},
          {"nearest_limit", point_json(report.points[report.nearest_limit], robot.table)},
          {"points", points}};
}

void print_path(const workspace::PathStatus& report) {
  const workspace::PathPoint& worst = report.points[report.worst_conditioned];
  const workspace::PathPoint& nearest = report.points[report.nearest_limit];
  std::printf("%zu points over %.1f deg of joint travel\n", report.points.size(), report.joint_travel_rad / kDegree);
  std::printf("least singular value %.4f at %.1f %% of the way, condition %.1f\n", worst.least_singular_value,
              100.0 * worst.way, workspace::condition_number(worst));
  std::printf("nearest limit: theta %d, %.3f deg left at %.1f %% of the way\n", nearest.nearest_theta,
              nearest.limit_margin_rad / kDegree, 100.0 * nearest.way);
}

}  // namespace

std::uint32_t mask_of(const std::vector<HoldArgument>& holds) {
  std::uint32_t mask = 0;
  for (const HoldArgument& hold : holds) mask |= 1u << (hold.theta - 1);
  return mask;
}

std::vector<HoldArgument> holds_of(const ReachOptions& options, const cable::RobotParams& robot) {
  return options.hold.empty() ? std::vector<HoldArgument>{} : parse_hold(options.hold, robot);
}

void require_free(std::uint32_t held_mask, std::int32_t theta_count, const std::string& what) {
  const std::uint32_t all = (1u << theta_count) - 1u;
  if ((held_mask & all) == all)
    throw launcher::BadInput("--hold: nothing is left that moves " + what + "; free at least one of theta 1 to " +
                             std::to_string(theta_count));
}

int reach_along_path(const ReachOptions& options, const config::RobotConfig& robot) {
  std::vector<cable::ThetaVector> waypoints_rad;
  if (options.path.empty()) {
    waypoints_rad = {parse_pose_deg("--from-deg", options.from_deg, robot),
                     parse_pose_deg("--to-deg", options.to_deg, robot)};
  } else {
    waypoints_rad = read_waypoints(options.path, robot.table);
  }
  const auto holds = holds_of(options, robot.table);
  for (const HoldArgument& hold : holds) {
    if (hold.has_value)
      throw launcher::BadInput("--hold: a path gives every angle; name the held thetas without values, e.g. 7,9");
  }
  const std::uint32_t held_mask = mask_of(holds);
  require_free(held_mask, robot.table.theta_count(), "the tip");
  const workspace::PathStatus report = workspace::examine_path(robot.table, waypoints_rad, held_mask);
  if (!options.svg_file.empty())
    launcher::write_output(options.svg_file, workspace::path_picture(robot, report, held_mask));
  if (options.json) {
    std::puts(path_json(report, held_mask, robot).dump().c_str());
  } else {
    print_path(report);
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
