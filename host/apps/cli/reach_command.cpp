#include <cstdio>
#include <optional>

#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/carry_report.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/pose_json.hpp"
#include "host/apps/cli/reach_along_path.hpp"
#include "host/apps/cli/serial_commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/theta_numbers.hpp"
#include "host/planning/workspace/picture.hpp"
#include "host/planning/workspace/region.hpp"

namespace liana::cli {
namespace {

// --- what is asked ---

bool is_path(const ReachOptions& options) { return !options.path.empty() || !options.to_deg.empty(); }

// Options that only one of the two uses have no silent effect on the other.
void refuse_contradictions(const ReachOptions& options) {
  const auto refuse = [](const char* text) { throw launcher::BadInput(text); };
  if (!options.path.empty() && !options.to_deg.empty()) refuse("--path: not together with --to-deg; give one of them");
  if (!options.path.empty() && !options.from_deg.empty())
    refuse("--path: not together with --from-deg; the file's first waypoint is the start");
  if (!options.to_deg.empty() && options.from_deg.empty()) refuse("--to-deg: needs --from-deg, where the path begins");
  if (options.carry && (is_path(options) || !options.scene.empty() || !options.node.empty() || !options.hold.empty() ||
                        !options.from_deg.empty()))
    refuse(
        "--carry: is about all poses of the tip; leave out --path, --to-deg, --from-deg, --hold, --node and --scene");
  if (!is_path(options)) return;
  if (!options.scene.empty()) refuse("--scene: is drawn with a region only; leave it out for a path");
  if (!options.node.empty()) refuse("--node: a path is examined for the tip; leave it out");
}

// A region of either kind of arm.
struct RegionQuestion {
  workspace::ReachArm arm;
  workspace::ArmDrawn drawn;
  workspace::RegionRequest request;
};

workspace::RegionRequest request_without_node(const ReachOptions& options) {
  workspace::RegionRequest request;
  request.samples = static_cast<std::int32_t>(
      parse_whole("--samples", options.samples, workspace::kMinSamples, workspace::kMaxSamples));
  request.seed = options.seed;
  return request;
}

RegionQuestion question_of(const ReachOptions& options, const config::RobotConfig& robot) {
  RegionQuestion asked{workspace::arm_of(robot.table), {robot.name, robot.module_radius_m, {}}, {}};
  workspace::AngleVector& pose_rad = asked.drawn.angle_rad;
  if (!options.from_deg.empty()) pose_rad = parse_pose_deg("--from-deg", options.from_deg, robot);
  const std::int32_t tip = robot.table.segment_count;
  const std::int32_t node = options.node.empty() ? tip : parse_node("--node", options.node, robot.table);
  asked.request = request_without_node(options);
  const auto holds = holds_of(options, robot.table);
  for (const HoldArgument& hold : holds) {
    if (hold.has_value) pose_rad[static_cast<std::size_t>(hold.theta - 1)] = hold.value_deg * kDegree;
  }
  asked.request.point = {.node = node, .held_mask = mask_of(holds)};
  asked.request.held_rad = pose_rad;
  require_free(asked.request.point.held_mask, 2 * node, "node " + std::to_string(node));
  return asked;
}

// Joint angles 0, or as near to it as the ranges let them: where the arm is drawn when nobody says where.
workspace::AngleVector nearest_to_zero(const workspace::ReachArm& arm) {
  workspace::AngleVector angle_rad{};
  for (std::size_t i = 0; i < angle_rad.size(); ++i) angle_rad[i] = workspace::into_range(arm.range[i], 0.0);
  return angle_rad;
}

RegionQuestion question_of(const ReachOptions& options, const config::SerialRobotConfig& robot) {
  refuse_cable_option("--hold", options.hold, robot, "leave it out, every joint moves");
  const char* instead = "leave it out; liana sweep --json says how well conditioned the arm is";
  refuse_cable_option("--path", options.path, robot, instead);
  refuse_cable_option("--to-deg", options.to_deg, robot, instead);
  RegionQuestion asked{
      workspace::arm_of(robot.table), {robot.name, robot.link_radius_m, {}}, request_without_node(options)};
  asked.drawn.angle_rad = options.from_deg.empty()
                              ? nearest_to_zero(asked.arm)
                              : workspace::angles_of(parse_pose_deg("--from-deg", options.from_deg, robot));
  asked.request.point.node = robot.table.joint_count;
  if (!options.node.empty())
    asked.request.point.node = static_cast<std::int32_t>(
        parse_whole("--node", options.node, 1, robot.table.joint_count, ": a joint, the end of whose link is meant"));
  asked.request.held_rad = asked.drawn.angle_rad;
  return asked;
}

// --- what is answered ---

Json held_json(const RegionQuestion& asked) {
  Json held = Json::object();
  for (std::size_t i = 0; i < static_cast<std::size_t>(asked.arm.angle_count); ++i) {
    if (asked.request.point.held_mask >> i & 1u) held[std::to_string(i + 1)] = asked.request.held_rad[i] / kDegree;
  }
  return held;
}

Json end_json(const workspace::BoundaryPoint& end, const workspace::ReachArm& arm) {
  return {{"distance_m", end.distance_m},
          {"point_m", end.point_in_base_m},
          {"theta_deg", degrees_json(end.angle_rad, arm.angle_count)},
          {"binding_theta", config::theta_numbers(end.binding)}};
}

Json bins_json(const workspace::Region& region, const workspace::ReachArm& arm) {
  Json bins = Json::array();
  for (const workspace::DirectionBin& bin : region.bins) {
    Json row = {{"polar_deg", bin.polar_rad / kDegree},
                {"azimuth_deg", bin.azimuth_rad / kDegree},
                {"polar_width_deg", bin.polar_width_rad / kDegree},
                {"azimuth_width_deg", bin.azimuth_width_rad / kDegree},
                {"samples", bin.samples},
                {"outer", nullptr},
                {"inner", nullptr}};
    if (bin.samples > 0) {
      row["outer"] = end_json(bin.outer, arm);
      row["inner"] = end_json(bin.inner, arm);
    }
    bins.push_back(row);
  }
  return bins;
}

Json shells_json(const workspace::Region& region) {
  Json shells = Json::array();
  const double width_m = region.length_m / workspace::kRadialShells;
  for (std::size_t i = 0; i < workspace::kRadialShells; ++i) {
    const double from_m = static_cast<double>(i) * width_m;
    shells.push_back({{"from_m", from_m}, {"to_m", from_m + width_m}, {"share", region.shell_share[i]}});
  }
  return shells;
}

Json binding_json(const workspace::Region& region, const workspace::ReachArm& arm) {
  Json shares = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i)
    shares.push_back(region.outer_binding_share[i]);
  return {{"theta_share", shares}, {"no_limit_share", region.outer_stretched_share}};
}

Json region_json(const RegionQuestion& asked, const workspace::Region& region) {
  Json extent = Json::object();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent[std::string(1, "xyz"[axis])] = {region.extent_m[0][axis], region.extent_m[1][axis]};
  }
  return {{"robot", asked.drawn.name},
          {"node", asked.request.point.node},
          {"held_deg", held_json(asked)},
          {"samples", asked.request.samples},
          {"seed", asked.request.seed},
          {"dimension", region.dimension},
          {"origin_m", region.origin_in_base_m},
          {"length_m", region.length_m},
          {"extent_m", extent},
          {"nearest_m", region.nearest_m},
          {"farthest_m", region.farthest_m},
          {"radial_profile", shells_json(region)},
          {"outer_binding", binding_json(region, asked.arm)},
          {"boundary", bins_json(region, asked.arm)}};
}

void print_region(const RegionQuestion& asked, const workspace::Region& region) {
  const workspace::ReachArm& arm = asked.arm;
  const auto text = [](std::string_view name) { return std::string(name); };
  std::printf("%s %d, held: %s\n", text(arm.node_name).c_str(), asked.request.point.node,
              workspace::held_text(arm, asked.request.point.held_mask, asked.request.held_rad).c_str());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::printf("%c: %.3f .. %.3f m\n", "xyz"[axis], region.extent_m[0][axis], region.extent_m[1][axis]);
  }
  const Vec3& origin = region.origin_in_base_m;
  std::printf("distance from (%.3f, %.3f, %.3f): %.3f .. %.3f m (%s %.3f m)\n", origin[0], origin[1], origin[2],
              region.nearest_m, region.farthest_m, text(arm.length_name).c_str(), region.length_m);
  std::printf("what binds at the outer boundary: no limit %.0f %%", 100.0 * region.outer_stretched_share);
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i) {
    if (region.outer_binding_share[i] > 0.0)
      std::printf(", %s %zu %.0f %%", text(arm.angle_name).c_str(), i + 1, 100.0 * region.outer_binding_share[i]);
  }
  std::printf("\n");
}

int reach_region(const ReachOptions& options, const RegionQuestion& asked) {
  std::optional<config::SceneConfig> scene;
  if (!options.scene.empty()) scene = launcher::scene_of(options.scene);
  const workspace::Region region = workspace::explore_region(asked.arm, asked.request);
  if (region.dimension == 0)
    throw launcher::BadInput("--node: '" + options.node +
                             "': no joint moves it, it lies on the axes of all before it; " +
                             "allowed: one further on, or leave it out for the tip");
  if (!options.svg_file.empty()) {
    launcher::write_output(
        options.svg_file,
        workspace::region_picture(asked.arm, asked.drawn, scene ? &*scene : nullptr, asked.request, region));
  }
  if (options.json) {
    std::puts(region_json(asked, region).dump().c_str());
  } else {
    print_region(asked, region);
  }
  return launcher::kExitOk;
}

int reach_carry(const ReachOptions& options, const config::RobotConfig& robot) {
  const workspace::RegionRequest request = request_without_node(options);
  const std::vector<workspace::Carried> carried = all_carried(robot, request.samples, request.seed);
  if (!options.svg_file.empty()) launcher::write_output(options.svg_file, workspace::carry_picture(robot, carried));
  const Json report = carry_json(robot, carried);
  if (options.json) {
    std::puts(Json{{"robot", robot.name}, {"samples", request.samples}, {"seed", request.seed}, {"carries", report}}
                  .dump()
                  .c_str());
  } else {
    print_carry(report);
  }
  return launcher::kExitOk;
}

}  // namespace

int reach_command(const ReachOptions& options) {
  refuse_contradictions(options);
  if (!options.svg_file.empty()) launcher::check_output("--svg", options.svg_file);
  if (const auto serial = launcher::serial_robot_for_kinematics(options.robot)) {
    if (options.carry) throw launcher::BadInput("--carry: robot " + options.robot + " has no cables; leave it out");
    return reach_region(options, question_of(options, *serial));
  }
  const config::RobotConfig robot = launcher::robot_for_kinematics(options.robot);
  if (options.carry) return reach_carry(options, robot);
  return is_path(options) ? reach_along_path(options, robot) : reach_region(options, question_of(options, robot));
}

}  // namespace liana::cli
