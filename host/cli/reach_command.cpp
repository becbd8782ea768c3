#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "firmware_like/math/trig.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/commands.hpp"
#include "host/config/field.hpp"
#include "host/config/theta_numbers.hpp"
#include "host/json/json.hpp"
#include "host/reach/path.hpp"
#include "host/reach/picture.hpp"
#include "host/reach/region.hpp"
#include "host/system/errors.hpp"
#include "host/system/output.hpp"
#include "host/system/tables.hpp"

namespace liana::cli {
namespace {

// --- what is asked ---

std::string number_list(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ",") + Json(number).dump();
  return text;
}

// The waypoints of a file: what `liana plan --json` prints, or a JSON object with waypoints_deg (rows of joint angles,
// degrees).
std::vector<cable::ThetaVector> read_waypoints(const std::string& path, const cable::RobotTable& robot) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable))
    throw system::BadInput("--path: " + path + ": cannot be read; give an existing JSON file with waypoints_deg");
  const std::string text = system::checked([&] { return config::read_text_file(path); });
  const Json document = system::checked(
      [&] { return config::parse_json(text, "--path: " + path, "give a JSON object with waypoints_deg"); });
  const Json rows = document.is_object() ? document.value("waypoints_deg", Json()) : Json();
  if (!rows.is_array() || rows.empty() || rows.size() > reach::kMaxWaypoints) {
    throw system::BadInput("--path: " + path + ": waypoints_deg: allowed: a JSON object with 1 to " +
                           std::to_string(reach::kMaxWaypoints) + " rows of joint angles under this key");
  }
  std::vector<cable::ThetaVector> waypoints;
  for (const Json& row : rows) {
    const std::string name = "--path: " + path + ": waypoints_deg row " + std::to_string(waypoints.size() + 1);
    const auto is_number = [](const Json& value) { return value.is_number(); };
    if (!row.is_array() || !std::all_of(row.begin(), row.end(), is_number))
      throw system::BadInput(name + ": allowed: an array of numbers");
    waypoints.push_back(parse_theta_deg(name, number_list(row.get<std::vector<double>>()), robot));
  }
  return waypoints;
}

bool is_path(const ReachOptions& options) { return !options.path.empty() || !options.to_deg.empty(); }

// Options that only one of the two uses have no silent effect on the other.
void refuse_contradictions(const ReachOptions& options) {
  const auto refuse = [](const char* text) { throw system::BadInput(text); };
  if (!options.path.empty() && !options.to_deg.empty()) refuse("--path: not together with --to-deg; give one of them");
  if (!options.path.empty() && !options.from_deg.empty())
    refuse("--path: not together with --from-deg; the file's first waypoint is the start");
  if (!options.to_deg.empty() && options.from_deg.empty()) refuse("--to-deg: needs --from-deg, where the path begins");
  if (!is_path(options)) return;
  if (!options.scene.empty()) refuse("--scene: is drawn with a region only; leave it out for a path");
  if (!options.node.empty()) refuse("--node: a path is examined for the tip; leave it out");
}

std::uint32_t mask_of(const std::vector<HoldArgument>& holds) {
  std::uint32_t mask = 0;
  for (const HoldArgument& hold : holds) mask |= 1u << (hold.theta - 1);
  return mask;
}

std::vector<HoldArgument> holds_of(const ReachOptions& options, const cable::RobotTable& robot) {
  return options.hold.empty() ? std::vector<HoldArgument>{} : parse_hold(options.hold, robot);
}

void require_free(std::uint32_t held_mask, std::int32_t theta_count, const std::string& what) {
  const std::uint32_t all = (1u << theta_count) - 1u;
  if ((held_mask & all) == all)
    throw system::BadInput("--hold: nothing is left that moves " + what + "; free at least one of theta 1 to " +
                           std::to_string(theta_count));
}

reach::RegionRequest region_request(const ReachOptions& options, const cable::RobotTable& robot,
                                    const cable::ThetaVector& pose_rad) {
  reach::RegionRequest request;
  request.point.node = options.node.empty() ? robot.segment_count : parse_node("--node", options.node, robot);
  request.samples =
      static_cast<std::int32_t>(parse_whole("--samples", options.samples, reach::kMinSamples, reach::kMaxSamples));
  request.held_rad = pose_rad;
  const auto holds = holds_of(options, robot);
  request.point.held_mask = mask_of(holds);
  for (const HoldArgument& hold : holds) {
    if (hold.has_value) request.held_rad[static_cast<std::size_t>(hold.theta - 1)] = hold.value_deg * kDegree;
  }
  require_free(request.point.held_mask, 2 * request.point.node, "node " + std::to_string(request.point.node));
  request.seed = options.seed;
  return request;
}

// --- what is answered ---

Json degrees(const cable::ThetaVector& theta_rad, const cable::RobotTable& robot) {
  Json list = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(robot.theta_count()); ++i)
    list.push_back(theta_rad[i] / kDegree);
  return list;
}

Json held_json(const reach::RegionRequest& request, const cable::RobotTable& robot) {
  Json held = Json::object();
  for (std::size_t i = 0; i < static_cast<std::size_t>(robot.theta_count()); ++i) {
    if (request.point.held_mask >> i & 1u) held[std::to_string(i + 1)] = request.held_rad[i] / kDegree;
  }
  return held;
}

Json end_json(const reach::BoundaryPoint& end, const cable::RobotTable& robot) {
  return {{"distance_m", end.distance_m},
          {"point_m", end.point_in_base_m},
          {"theta_deg", degrees(end.theta_rad, robot)},
          {"binding_theta", config::theta_numbers(end.binding)}};
}

Json bins_json(const reach::Region& region, const cable::RobotTable& robot) {
  Json bins = Json::array();
  for (const reach::DirectionBin& bin : region.bins) {
    Json row = {{"polar_deg", bin.polar_rad / kDegree},
                {"azimuth_deg", bin.azimuth_rad / kDegree},
                {"polar_width_deg", bin.polar_width_rad / kDegree},
                {"azimuth_width_deg", bin.azimuth_width_rad / kDegree},
                {"samples", bin.samples},
                {"outer", nullptr},
                {"inner", nullptr}};
    if (bin.samples > 0) {
      row["outer"] = end_json(bin.outer, robot);
      row["inner"] = end_json(bin.inner, robot);
    }
    bins.push_back(row);
  }
  return bins;
}

Json shells_json(const reach::Region& region) {
  Json shells = Json::array();
  const double width_m = region.length_m / reach::kRadialShells;
  for (std::size_t i = 0; i < reach::kRadialShells; ++i) {
    const double from_m = static_cast<double>(i) * width_m;
    shells.push_back({{"from_m", from_m}, {"to_m", from_m + width_m}, {"share", region.shell_share[i]}});
  }
  return shells;
}

Json binding_json(const reach::Region& region, const cable::RobotTable& robot) {
  Json shares = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(robot.theta_count()); ++i)
    shares.push_back(region.outer_binding_share[i]);
  return {{"theta_share", shares}, {"no_limit_share", region.outer_stretched_share}};
}

Json region_json(const reach::RegionRequest& request, const reach::Region& region, const config::RobotConfig& robot) {
  Json extent = Json::object();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent[std::string(1, "xyz"[axis])] = {region.extent_m[0][axis], region.extent_m[1][axis]};
  }
  return {{"robot", robot.name},
          {"node", request.point.node},
          {"held_deg", held_json(request, robot.table)},
          {"samples", request.samples},
          {"seed", request.seed},
          {"dimension", region.dimension},
          {"origin_m", region.origin_in_base_m},
          {"length_m", region.length_m},
          {"extent_m", extent},
          {"nearest_m", region.nearest_m},
          {"farthest_m", region.farthest_m},
          {"radial_profile", shells_json(region)},
          {"outer_binding", binding_json(region, robot.table)},
          {"boundary", bins_json(region, robot.table)}};
}

Json point_json(const reach::PathPoint& point, const cable::RobotTable& robot) {
  const double condition = reach::condition_number(point);
  return {{"way", point.way},
          {"theta_deg", degrees(point.theta_rad, robot)},
          {"tip_m", point.tip_in_base_m},
          {"least_singular_value", point.least_singular_value},
          {"condition", std::isfinite(condition) ? Json(condition) : Json()},
          {"limit_margin_deg", point.limit_margin_rad / kDegree},
          {"nearest_theta", point.nearest_theta}};
}

Json path_json(const reach::PathReport& report, std::uint32_t held_mask, const config::RobotConfig& robot) {
  Json points = Json::array();
  for (const reach::PathPoint& point : report.points) points.push_back(point_json(point, robot.table));
  return {{"robot", robot.name},
          {"held_theta", config::theta_numbers(held_mask)},
          {"joint_travel_deg", report.joint_travel_rad / kDegree},
          {"waypoint_way", report.waypoint_way},
          {"worst_conditioned", point_json(report.points[report.worst_conditioned], robot.table)},
          {"nearest_limit", point_json(report.points[report.nearest_limit], robot.table)},
          {"points", points}};
}

void print_region(const reach::RegionRequest& request, const reach::Region& region, const cable::RobotTable& robot) {
  std::printf("node %d, held: %s\n", request.point.node,
              reach::held_text(robot, request.point.held_mask, request.held_rad).c_str());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::printf("%c: %.3f .. %.3f m\n", "xyz"[axis], region.extent_m[0][axis], region.extent_m[1][axis]);
  }
  const Vec3& origin = region.origin_in_base_m;
  std::printf("distance from (%.3f, %.3f, %.3f): %.3f .. %.3f m (straight arm %.3f m)\n", origin[0], origin[1],
              origin[2], region.nearest_m, region.farthest_m, region.length_m);
  std::printf("what binds at the outer boundary: no limit %.0f %%", 100.0 * region.outer_stretched_share);
  for (std::size_t i = 0; i < static_cast<std::size_t>(robot.theta_count()); ++i) {
    if (region.outer_binding_share[i] > 0.0)
      std::printf(", theta %zu %.0f %%", i + 1, 100.0 * region.outer_binding_share[i]);
  }
  std::printf("\n");
}

void print_path(const reach::PathReport& report) {
  const reach::PathPoint& worst = report.points[report.worst_conditioned];
  const reach::PathPoint& nearest = report.points[report.nearest_limit];
  std::printf("%zu points over %.1f deg of joint travel\n", report.points.size(), report.joint_travel_rad / kDegree);
  std::printf("least singular value %.4f at %.1f %% of the way, condition %.1f\n", worst.least_singular_value,
              100.0 * worst.way, reach::condition_number(worst));
  std::printf("nearest limit: theta %d, %.3f deg left at %.1f %% of the way\n", nearest.nearest_theta,
              nearest.limit_margin_rad / kDegree, 100.0 * nearest.way);
}

int reach_along_path(const ReachOptions& options, const config::RobotConfig& robot) {
  std::vector<cable::ThetaVector> waypoints_rad;
  if (options.path.empty()) {
    waypoints_rad = {parse_theta_deg("--from-deg", options.from_deg, robot.table),
                     parse_theta_deg("--to-deg", options.to_deg, robot.table)};
  } else {
    waypoints_rad = read_waypoints(options.path, robot.table);
  }
  const auto holds = holds_of(options, robot.table);
  for (const HoldArgument& hold : holds) {
    if (hold.has_value)
      throw system::BadInput("--hold: a path gives every angle; name the held thetas without values, e.g. 7,9");
  }
  const std::uint32_t held_mask = mask_of(holds);
  require_free(held_mask, robot.table.theta_count(), "the tip");
  const reach::PathReport report = reach::examine_path(robot.table, waypoints_rad, held_mask);
  if (!options.svg_file.empty()) system::write_output(options.svg_file, reach::path_picture(robot, report, held_mask));
  if (options.json) {
    std::puts(path_json(report, held_mask, robot).dump().c_str());
  } else {
    print_path(report);
  }
  return system::kExitOk;
}

int reach_region(const ReachOptions& options, const config::RobotConfig& robot) {
  std::optional<config::SceneConfig> scene;
  if (!options.scene.empty()) {
    scene = system::scene_of(options.scene);
  }
  cable::ThetaVector pose_rad{};
  if (!options.from_deg.empty()) pose_rad = parse_theta_deg("--from-deg", options.from_deg, robot.table);
  const reach::RegionRequest request = region_request(options, robot.table, pose_rad);
  for (std::size_t i = 0; i < cable::kMaxTheta; ++i) {
    if (request.point.held_mask >> i & 1u) pose_rad[i] = request.held_rad[i];
  }
  const reach::Region region = reach::explore_region(robot.table, request);
  if (!options.svg_file.empty()) {
    system::write_output(options.svg_file,
                         reach::region_picture(robot, scene ? &*scene : nullptr, request, region, pose_rad));
  }
  if (options.json) {
    std::puts(region_json(request, region, robot).dump().c_str());
  } else {
    print_region(request, region, robot.table);
  }
  return system::kExitOk;
}

}  // namespace

int reach_command(const ReachOptions& options) {
  refuse_contradictions(options);
  if (!options.svg_file.empty()) system::check_output("--svg", options.svg_file);
  const config::RobotConfig robot = system::robot_for_kinematics(options.robot);
  return is_path(options) ? reach_along_path(options, robot) : reach_region(options, robot);
}

}  // namespace liana::cli
