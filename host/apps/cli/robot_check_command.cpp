#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware_like/cable/arm/cable_monitor.hpp"
#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/carry_report.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/serial_robot_check.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/start_pose.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/calibration/calibrate.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/model/config/drive_names.hpp"
#include "host/model/config/field.hpp"
#include "host/planning/workspace/picture.hpp"
#include "host/planning/workspace/region.hpp"

namespace liana::cli {
namespace {

constexpr double kMinHoleDistance_m = 0.001, kMinHoleDistanceShare = 0.1;  // less in short modules: of their length
constexpr double kUnknown_m = 0.01e-3;   // of a length, after homing: arms of the bench stay above their floor by it
constexpr std::int32_t kSamples = 5000;  // of the workspace, whose boundary is then climbed to
constexpr std::int32_t kCarrySamples = 2000;
constexpr std::int32_t kTipValues = 6;  // place and attitude
constexpr double kEarth_m_s2 = 9.80665;

std::string text(const char* format, auto... values) {
  char line[300];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

Json buses_of(const config::BusesConfig& buses) {
  Json list = Json::array();
  for (std::size_t b = 0; b < buses.buses.size(); ++b) {
    list.push_back({{"name", buses.buses[b].name},
                    {"drives", buses.buses[b].nodes.size()},
                    {"worst_case_load", config::worst_case_load(buses, b)}});
  }
  return {{"name", buses.name}, {"rate_hz", buses.rate_hz}, {"max_load", buses.max_load}, {"buses", list}};
}

Json poses_of(const config::RobotConfig& robot, Json& problems) {
  Json poses = Json::object();
  for (const auto& [name, angles_deg] : robot.named_poses_deg) {
    const workspace::PoseTension planned = workspace::tension_at(robot, name);
    poses[name] = {{"least_N", planned.min_N}, {"most_N", planned.max_N}};
    if (const std::string why = workspace::refusal_of_pose(robot, name); !why.empty()) problems.push_back(why);
  }
  return poses;
}

// The first segment that bends.
const cable::SegmentParams& first_bending(const cable::RobotParams& table) {
  return table.segment[static_cast<std::size_t>(table.first_bending())];
}

// The pair that is nearest speaks for all.
void look_at_holes(const cable::RobotParams& table, Json& problems) {
  const cable::CableLayout layout = cable_layout(table);
  const auto cables = static_cast<std::size_t>(layout.cable_count);
  double shortest_m = first_bending(table).module_length_m;
  for (auto j = static_cast<std::size_t>(table.first_bending()); j < static_cast<std::size_t>(table.segment_count); ++j)
    shortest_m = std::min(shortest_m, table.segment[j].module_length_m);
  const double allowed_m = std::min(kMinHoleDistance_m, kMinHoleDistanceShare * shortest_m);
  double nearest_m = allowed_m;
  std::size_t first = 0, second = 0, pairs = 0;
  for (auto a = static_cast<std::size_t>(table.feed_count()); a < cables; ++a) {
    for (std::size_t b = a + 1; b < cables; ++b) {
      const double distance_m =
          std::hypot(layout.hole_y_m[a] - layout.hole_y_m[b], layout.hole_z_m[a] - layout.hole_z_m[b]);
      if (distance_m >= allowed_m) continue;
      ++pairs;
      if (distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      first = a;
      second = b;
    }
  }
  if (pairs == 0) return;
  const config::DriveNames names(table);
  problems.push_back(names.cable(first) + " and " + names.cable(second) +
                     text(": their holes are %.2g mm apart in the discs that both pass, %zu pairs less than %.2g mm: "
                          "turn a segment's cables.phase_deg, or widen hole_radius_m",
                          1e3 * nearest_m, pairs, 1e3 * allowed_m));
}

void look_at_fixtures(const config::RobotConfig& robot, Json& problems) {
  if (robot.jig_poses.empty()) return;
  std::vector<cable::ThetaVector> thetas_rad;
  for (const std::string& name : robot.jig_poses) thetas_rad.push_back(calibration::named_pose_rad(robot, name));
  try {
    calibration::check_poses(robot, thetas_rad);
  } catch (const std::runtime_error& error) {
    problems.push_back(std::string("jig_poses: ") + error.what());
  }
}

void look_at_zero(const config::RobotConfig& robot, Json& problems) {
  const std::vector<double>& zero_deg = robot.named_poses_deg.at("zero");
  for (std::size_t k = 0; k < zero_deg.size(); ++k) {
    if (zero_deg[k] == 0.0) continue;
    problems.push_back(
        text("named_poses_deg.zero: angle %zu is %g deg: allowed 0, it is the straight arm: give the "
             "pose another name",
             k + 1, zero_deg[k]));
    return;
  }
}

// What the straight arm, turned about its base at the tip's acceleration, asks of one cable there: an arm that needs
// more than the hard limit does not move as it is planned.
void look_at_mass(const config::RobotConfig& robot, const Json& table, Json& problems) {
  const double mass_kg = table.at("module").at("mass_kg").get<double>();
  double along_m = 0.0, inertia_kgm2 = 0.0;
  for (const Json& segment : table.at("segments")) {
    for (int m = 0; m < segment.at("modules").get<int>(); ++m) {
      along_m += segment.at("module_length_m").get<double>();
      inertia_kgm2 += mass_kg * along_m * along_m;
    }
  }
  const double needed_N =
      inertia_kgm2 * robot.table.limits.tip_accel_m_s2 / along_m / first_bending(robot.table).hole_radius_m;
  if (needed_N <= robot.table.tension.hard_limit_N) return;
  problems.push_back(
      text("module.mass_kg: %g: a cable would pull %.0f N to turn the arm at limits.tip_accel_m_s2: allowed "
           "up to tension.hard_limit_N, %g N: weigh a module, or lower the acceleration",
           mass_kg, needed_N, robot.table.tension.hard_limit_N));
}

// What nobody knows of a cable's length, times its stiffness, may not take the tension from what is planned to the
// floor at the motor. The shortest cable, of the first segment, is the stiffest.
void look_at_stiffness(const cable::RobotParams& table, Json& problems) {
  const cable::SegmentParams& first = first_bending(table);
  const double shortest_m = first.modules * first.module_length_m + table.lead_m;
  const double change_N = kUnknown_m * table.cable_EA_N / shortest_m;
  const double allowed_N = table.tension.plan_N - table.tension.floor_motor_N;
  if (change_N <= allowed_N) return;
  problems.push_back(
      text("cables.EA_N: %g: the shortest cable, %.3g m, loses %.3g N by a length error of %g mm: allowed up to "
           "tension.plan_N less floor_motor_N, %g N: more plan_N, a longer cables.lead_m, or EA_N up to %.4g",
           table.cable_EA_N, shortest_m, change_N, 1e3 * kUnknown_m, allowed_N, allowed_N * shortest_m / kUnknown_m));
}

// As the cable monitor takes it.
double stiffest_N_m(const cable::RobotParams& table) {
  cable::CableVector zero_payout_m = cable::cable_layout(table).zero_length_m;
  for (double& each : zero_payout_m) each += table.lead_m;
  const cable::CableWatchLimits limits = cable::make_cable_watch_limits(table, zero_payout_m);
  return *std::max_element(limits.stiffness_N_m.begin(), limits.stiffness_N_m.end());
}

// A reading moves by one step of encoder and torque at a time. Where these are a jump of the cable monitor (5005), the
// first motion faults. Half of a jump is left to noise and to slip in the holes (docs/explanation/fault-detection.md).
void look_at_steps(const cable::RobotParams& table, const Json& checked, Json& problems, Json& notes) {
  const double count_N = checked.at("N_per_count").get<double>();
  const double permille_N = checked.at("N_per_permille").get<double>();
  const double allowed_N = 0.5 * table.cable_monitor.jump_N, step_N = count_N + permille_N;
  if (step_N <= allowed_N) return;
  const bool faults = step_N > table.cable_monitor.jump_N;
  (faults ? problems : notes)
      .push_back(
          text("drives: a count is %.3g N of the stiffest cable, a permille of rated torque %.3g N: together %s up to "
               "%.3g N, %s of cables.monitor.jump_N (5005): ",
               count_N, permille_N, faults ? "allowed" : "better", faults ? 2.0 * allowed_N : allowed_N,
               faults ? "all" : "half") +
          (count_N > permille_N ? "more drives.counts_per_turn, a smaller drum_radius_m or a longer cables.lead_m"
                                : "a smaller drives.rated_torque_Nm, or a larger drum_radius_m"));
}

// Cables that move too little between any two poses do not tell their drives' directions.
void look_at_travel(const cable::RobotParams& table, Json& notes) {
  for (std::size_t j = 0; j < static_cast<std::size_t>(table.segment_count); ++j) {
    const cable::SegmentParams& segment = table.segment[j];
    if (cable::feeds(segment)) continue;
    const double most_m = segment.hole_radius_m * segment.modules * segment.theta_limit_rad;
    const double needed_m = calibration::min_change_m(table, j);
    if (most_m >= needed_m) continue;
    notes.push_back(
        text("segment %zu moves its cables by %.1f mm at most: liana calibrate needs %g mm: set drives.zero_counts "
             "and .direction by hand (docs/how-to/calibrate.md)",
             j + 1, 1e3 * most_m, 1e3 * needed_m));
  }
}

// How the arm is mounted, in words: a table in other units, or with a sign reversed, shows here.
void tell_weight(const cable::RobotParams& table, Json& notes) {
  const double gravity_m_s2 = norm(table.gravity_m_s2);
  if (gravity_m_s2 == 0.0) return;
  const double down_deg = std::asin(std::clamp(table.gravity_m_s2[0] / gravity_m_s2, -1.0, 1.0)) / kDegree;
  std::string note = std::fabs(down_deg) < 0.05 ? std::string("weight: the straight arm lies level")
                                                : text("weight: the straight arm points %.1f deg %s the horizontal",
                                                       std::fabs(down_deg), down_deg > 0.0 ? "below" : "above");
  if (std::fabs(gravity_m_s2 - kEarth_m_s2) > 0.1)
    note += text("; gravity_m_s2 is %.3g of the earth's, as a rig leaves it", gravity_m_s2 / kEarth_m_s2);
  notes.push_back(note);
}

void tell_base(const cable::RobotParams& table, Json& notes) {
  if (table.feed_count() == 0) return;
  const cable::SegmentParams& base = table.segment[0];
  const double rate_rad_s = table.limits.theta_rate_rad_s;
  notes.push_back(
      text("base: its slide goes %.3g m either way at up to %.3g mm/s, its roll %.3g deg at up to %.3g deg/s",
           base.slide_m_rad * base.theta_limit_rad, 1e3 * base.slide_m_rad * rate_rad_s, base.theta_limit_rad / kDegree,
           rate_rad_s / kDegree));
}

Json workspace_of(const cable::RobotParams& table) {
  workspace::RegionRequest request;
  request.point.node = table.segment_count;
  request.samples = kSamples;
  const workspace::Region region = workspace::explore_region(workspace::arm_of(table), request);
  return {{"length_m", region.length_m},
          {"nearest_m", region.nearest_m},
          {"farthest_m", region.farthest_m},
          {"least_m", region.extent_m[0]},
          {"most_m", region.extent_m[1]}};
}

Json checked_cable_robot(const config::RobotConfig& robot) {
  const cable::RobotParams& table = robot.table;
  std::int32_t modules = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(table.segment_count); ++j) modules += table.segment[j].modules;
  Json problems = Json::array();
  Json checked{{"robot", robot.name},
               {"kind", "cable"},
               {"segments", table.segment_count},
               {"most_segments", cable::kMaxSegments},
               {"modules", modules},
               {"angles", table.theta_count()},
               {"most_held", std::max(0, table.theta_count() - kTipValues)},
               {"cables", table.cable_count()},
               {"most_cables", cable::kMaxCables},
               {"mm_per_count", 1e3 * table.drive[0].metres_per_count},
               {"N_per_count", stiffest_N_m(table) * table.drive[0].metres_per_count},
               {"N_per_permille", table.drive[0].newtons_per_permille},
               {"planned_tension", poses_of(robot, problems)},
               {"workspace", workspace_of(table)},
               {"carries", carry_json(robot, all_carried(robot, kCarrySamples, 1))}};
  look_at_holes(table, problems);
  look_at_fixtures(robot, problems);
  const Json written = Json::parse(robot.canonical_json);
  look_at_zero(robot, problems);
  look_at_mass(robot, written, problems);
  look_at_stiffness(table, problems);
  Json notes = Json::array();
  look_at_steps(table, checked, problems, notes);
  look_at_travel(table, notes);
  tell_weight(table, notes);
  tell_base(table, notes);
  checked["problems"] = problems;
  checked["notes"] = notes;
  return checked;
}

void print_cable_robot(const Json& checked) {
  const auto number = [&](const char* key) { return checked[key].get<int>(); };
  std::printf(
      "%d of %d segments, %d modules, %d of %d cables, %.4f mm and %.3g N per count, %.3g N per permille of torque\n",
      number("segments"), number("most_segments"), number("modules"), number("cables"), number("most_cables"),
      checked["mm_per_count"].get<double>(), checked["N_per_count"].get<double>(),
      checked["N_per_permille"].get<double>());
  if (number("angles") < kTipValues) {
    std::printf("%d angles: places, not attitudes: missions and plans by joint angles\n", number("angles"));
  } else {
    std::printf("%d angles: the tip reaches places and attitudes, and %d can be held meanwhile\n", number("angles"),
                number("most_held"));
  }
  const Json& space = checked["workspace"];
  std::printf("tip: %.3f to %.3f m from the base (straight arm %.3f m)", space["nearest_m"].get<double>(),
              space["farthest_m"].get<double>(), space["length_m"].get<double>());
  for (std::size_t axis = 0; axis < 3; ++axis)
    std::printf("; %c %.3f to %.3f m", "xyz"[axis], space["least_m"][axis].get<double>(),
                space["most_m"][axis].get<double>());
  std::printf("\n");
  for (const auto& [name, planned] : checked["planned_tension"].items())
    std::printf("pose %s: %.1f to %.1f N planned at the motors\n", name.c_str(), planned["least_N"].get<double>(),
                planned["most_N"].get<double>());
  print_carry(checked["carries"]);
}

void print_parts(const Json& checked) {
  std::printf("%s, a %s arm\n", checked["robot"].get<std::string>().c_str(),
              checked["kind"].get<std::string>().c_str());
  if (checked["kind"] == "cable") print_cable_robot(checked);
  if (checked["kind"] == "serial") print_swings(checked["swings"]);
  const Json& buses = checked["buses"];
  for (const Json& bus : buses["buses"]) {
    std::printf("bus %s of %s: %d drives at %g Hz, worst-case load %.1f %% of %.0f %% allowed\n",
                bus["name"].get<std::string>().c_str(), buses["name"].get<std::string>().c_str(),
                bus["drives"].get<int>(), buses["rate_hz"].get<double>(), 100.0 * bus["worst_case_load"].get<double>(),
                100.0 * buses["max_load"].get<double>());
  }
  for (const Json& note : checked["notes"]) std::printf("note: %s\n", note.get<std::string>().c_str());
  for (const Json& problem : checked["problems"]) std::printf("problem: %s\n", problem.get<std::string>().c_str());
  std::printf(checked["problems"].empty() ? "fits\n" : "does NOT fit as it is\n");
}

}  // namespace

int robot_check_command(const RobotCheckOptions& options) {
  const std::string robot_text = launcher::evaluate_table("robot", options.robot);
  const launcher::TableText table = launcher::buses_of(options.robot, robot_text, options.bus);
  const config::BusesConfig buses = launcher::checked([&] { return config::parse_buses(table.json, table.name); });
  const bool is_serial = launcher::checked([&] { return config::robot_kind(robot_text, options.robot); }) == "serial";
  if (is_serial && !options.svg_file.empty())
    throw launcher::BadInput("--svg: robot " + options.robot + " has a serial arm, without cables; leave it out");
  if (!is_serial && !options.scene.empty())
    throw launcher::BadInput("--scene: robot " + options.robot + " has cables and carries no payload; leave it out");
  const config::SceneConfig scene = options.scene.empty() ? config::SceneConfig{} : launcher::scene_of(options.scene);
  Json checked;
  if (is_serial) {
    checked = launcher::checked(
        [&] { return checked_serial_robot(config::parse_serial_robot(robot_text, options.robot, buses), scene); });
  } else {
    const config::RobotConfig robot =
        launcher::checked([&] { return config::parse_robot(robot_text, options.robot, "nominal", buses); });
    if (!options.svg_file.empty()) launcher::write_output(options.svg_file, workspace::routing_picture(robot));
    checked = checked_cable_robot(robot);
  }
  checked["buses"] = buses_of(buses);
  if (options.json) {
    std::puts(checked.dump().c_str());
  } else {
    print_parts(checked);
  }
  return checked["problems"].empty() ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
