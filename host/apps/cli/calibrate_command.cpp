#include <cstdio>
#include <iostream>
#include <sstream>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/calibrate_tracker.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/fields_report.hpp"
#include "host/apps/launcher/calibrate_session.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/calibration/calibrate.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/drives/calibration/jig_prompt.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::cli {
namespace {

constexpr const char* kFixtures = "zero,jig,prepare";

// The poses for which there are fixtures: those asked for, else those of the table.
std::vector<std::string> poses_of(const CalibrateOptions& options, const config::RobotConfig& robot) {
  if (options.poses.empty() && !robot.jig_poses.empty()) return robot.jig_poses;
  std::vector<std::string> names;
  const std::string list = options.poses.empty() ? kFixtures : options.poses;
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
  return list;
}

// What runs in any case.
launcher::RunOptions run_options(const CalibrateOptions& options, bool simulated) {
  launcher::RunOptions run;
  if (options.robot != CalibrateOptions{}.robot) run.scene = "none";  // the slit's scene is that of its own arm
  run.robot = options.robot;
  run.bus = options.bus;
  run.physics = options.physics;
  run.simulated_arm = simulated;
  run.seed = options.seed;
  return run;
}

// What runs while the arm lies in a fixture.
launcher::SystemLayout plan_for(const CalibrateOptions& options, bool simulated, const std::string& pose) {
  launcher::RunOptions run = run_options(options, simulated);
  run.fixture = pose;
  run.cross_wired = options.cross_wired;
  return launcher::make_layout(run);
}

// What `measure` finds with the programs of the plan, of which nothing is left behind.
template <class Measure>
auto found_with(const launcher::SystemLayout& plan, const launcher::InterruptGuard& interrupts,
                const Measure& measure) {
  try {
    const auto found = measure(launcher::CalibrateSession(plan, interrupts));  // the programs end with the session
    launcher::clean_up(plan, true);
    return found;
  } catch (...) {
    launcher::clean_up(plan, true);
    throw;
  }
}

// Ctrl-C counts at any time, while the programs start and end, too; it is why they then fail.
calibration::CalibrationReading read_in(const CalibrateOptions& options, bool simulated, const std::string& pose) {
  const launcher::InterruptGuard interrupts;
  calibration::CalibrationReading reading;
  try {
    reading = found_with(plan_for(options, simulated, pose), interrupts,
                         [](launcher::CalibrateSession&& session) { return session.read(); });
  } catch (const std::runtime_error&) {
    if (interrupts.count() == 0) throw;
  }
  if (interrupts.count() > 0) throw launcher::Interrupted("interrupted: nothing was calibrated");
  return reading;
}

// One fixture after the other; the drives are off all the time. Between the fixtures nothing runs: whoever moves the
// arm has it for himself.
std::vector<calibration::CalibrationReading> read_all(const CalibrateOptions& options, bool simulated,
                                                      const std::vector<std::string>& poses,
                                                      const std::vector<cable::ThetaVector>& thetas_rad) {
  std::vector<calibration::CalibrationReading> readings;
  if (!simulated)
    launcher::clean_up(plan_for(options, simulated, poses.front()),
                       true);  // what is missing is said before anybody lifts the arm
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (!simulated) calibration::wait_for_fixture(std::cin, std::cerr, poses[p], p + 1, poses.size());
    std::fprintf(stderr, "pose %zu of %zu, %s: reading the drives\n", p + 1, poses.size(), poses[p].c_str());
    readings.push_back(read_in(options, simulated, poses[p]));
    readings.back().theta_rad = thetas_rad[p];
  }
  return readings;
}

void show(const calibration::CalibrationResult& result, const config::DriveNames& names, bool as_json) {
  if (as_json) {
    Json report{{"problems", result.problems}, {"calibration", nullptr}};
    if (result.problems.empty()) report["calibration"] = Json::parse(calibration::calibration_json(result.calibration));
    std::printf("%s\n", report.dump().c_str());
    return;
  }
  for (const std::string& problem : result.problems) std::printf("%s\n", problem.c_str());
  if (!result.problems.empty()) return;
  std::printf("drive                          serial  direction      zero  drum radius mm  offset mm  tension N\n");
  for (std::size_t i = 0; i < result.calibration.cables.size(); ++i) {
    const calibration::CableCalibration& cable = result.calibration.cables[i];
    std::printf("%-29s  %6u  %9d  %8d  %14.4f  %9.3f  %9.1f\n", names.drive(i).c_str(), cable.serial, cable.direction,
                cable.zero_counts, 1e3 * cable.drum_radius_m, 1e3 * cable.offset_m, cable.pretension_N);
  }
}

std::string friction_text(const calibration::FrictionOf& friction) {
  char text[64];
  std::snprintf(text, sizeof text, "mu %.4f +- %.4f", friction.mu, friction.sd);
  return text;
}

void show(const calibration::Friction& friction, const calibration::Calibration& whole, bool as_json) {
  if (as_json) {
    std::printf("%s\n", Json::parse(calibration::calibration_json(whole)).at("friction").dump().c_str());
    return;
  }
  std::printf("friction of the arm: %s\n", friction_text(friction.arm).c_str());
  for (std::size_t j = 0; j < friction.segment.size(); ++j) {
    const auto& segment = friction.segment[j];
    std::printf("  segment %zu: %s\n", j + 1, segment ? friction_text(*segment).c_str() : "cannot be told apart");
  }
}

Json json_of(const calibration::LoadError& error) {
  return {{"torque_Nm", error.torque_Nm}, {"tension_N", error.tension_N}};
}

void show(const calibration::LoadResult& load, const config::RobotConfig& robot, bool as_json) {
  if (as_json) {
    Json report = fields_json(load);
    report["before"] = json_of(load.before);
    report["after"] = json_of(load.after);
    report["with_gains"] = json_of(load.with_gains);
    std::printf("%s\n", report.dump().c_str());
    return;
  }
  print_fields(load, robot.table);
  std::printf(
      "not explained, rms: %.3f N m and %.2f N with the table, %.3f N m and %.2f N as found, %.3f N m and %.2f N "
      "with the torque gains of the drives as found, too\n",
      load.before.torque_Nm, load.before.tension_N, load.after.torque_Nm, load.after.tension_N,
      load.with_gains.torque_Nm, load.with_gains.tension_N);
  print_problems(load);
}

// Where the load is measured; what is wrong with a pose is said before anything starts.
std::vector<calibration::LoadPose> load_poses(const CalibrateOptions& options, const config::RobotConfig& robot) {
  return launcher::checked([&] {
    if (options.poses.empty()) return calibration::load_poses(robot.table);
    std::vector<calibration::LoadPose> poses;
    for (const std::string& name : poses_of(options, robot)) {
      try {
        poses.push_back(calibration::load_pose(robot.table, calibration::named_pose_rad(robot, name)));
      } catch (const std::runtime_error& error) {
        throw std::runtime_error("--poses: '" + name + "': " + error.what());
      }
    }
    if (poses.size() < calibration::kMinLoadPoses)
      throw std::runtime_error("--poses: '" + options.poses + "': allowed with --load are at least " +
                               std::to_string(calibration::kMinLoadPoses) + " poses: name more, or leave it out");
    return poses;
  });
}

// The arm moves: what was found of its friction, or of its weight and springs, is added to what is known of it.
int measure_moving(const CalibrateOptions& options, bool simulated, const config::RobotConfig& robot) {
  const std::string flag = options.load ? "--load" : "--friction";
  if (!options.out_file.empty() && options.calibration.empty())
    throw launcher::BadInput("--out: '" + options.out_file + "': allowed with " + flag +
                             " only beside --calibration FILE, which the result is added to: run liana calibrate "
                             "without " +
                             flag + " first");
  calibration::Calibration whole;
  if (!options.calibration.empty())
    whole = launcher::checked(
        [&] { return calibration::load_calibration(options.calibration, robot, calibration::today_utc()); });
  launcher::RunOptions run = run_options(options, simulated);
  run.calibration = options.calibration;
  const std::vector<calibration::LoadPose> poses =
      options.load ? load_poses(options, robot) : std::vector<calibration::LoadPose>{};
  const launcher::SystemLayout plan = launcher::make_layout(run);
  const launcher::InterruptGuard interrupts;
  if (options.load) {
    config::RobotConfig measured = robot;  // its geometry as it is known
    calibration::set_fields(calibration::geometry_fields(robot.table), whole.fields, measured.table);
    const calibration::LoadResult load = found_with(
        plan, interrupts, [&](launcher::CalibrateSession&& session) { return session.measure_load(measured, poses); });
    show(load, robot, options.json);
    if (!load.problems.empty()) return launcher::kExitFailure;
    whole.fields = calibration::merged(calibration::table_fields(robot.table), whole.fields, load.values);
  } else {
    whole.friction = found_with(plan, interrupts,
                                [&](launcher::CalibrateSession&& session) { return session.measure_friction(robot); });
    show(*whole.friction, whole, options.json);
  }
  if (!options.out_file.empty()) launcher::write_output(options.out_file, calibration::calibration_json(whole));
  return launcher::kExitOk;
}

}  // namespace

int calibrate_command(const CalibrateOptions& options) {
  const std::string text = launcher::evaluate_table("robot", options.robot);
  if (launcher::checked([&] { return config::robot_kind(text, options.robot); }) == "serial")
    throw launcher::BadInput("--robot: '" + options.robot +
                             "': has a serial arm, whose encoders are absolute: allowed a cable arm; its zeros are "
                             "drives.zero_counts of its table");
  const launcher::TableText table = launcher::buses_of(options.robot, text, options.bus);
  const config::BusesConfig buses = launcher::checked([&] { return config::parse_buses(table.json, table.name); });
  const bool simulated = buses.backend == "embedded";
  if (!simulated && !options.cross_wired.empty())
    throw launcher::BadInput("--cross-wired: '" + options.cross_wired + "': bus table " + table.name +
                             " has real drives: allowed with the simulated arm only, --bus=embedded: leave it out");
  const config::RobotConfig robot =
      launcher::checked([&] { return config::parse_robot(text, options.robot, options.physics, buses); });
  launcher::check_cross_wired(options.cross_wired, static_cast<std::size_t>(robot.table.cable_count()));
  if (!options.out_file.empty()) launcher::check_output("--out", options.out_file);
  if (!options.tracker.empty()) return calibrate_by_tracker(options, robot);
  if (options.friction || options.load) return measure_moving(options, simulated, robot);
  if (!options.calibration.empty())
    throw launcher::BadInput("--calibration: '" + options.calibration +
                             "': allowed with --friction, --load or --tracker only: leave it out");
  const std::vector<std::string> poses = poses_of(options, robot);
  std::vector<cable::ThetaVector> thetas_rad;
  try {
    for (const std::string& pose : poses) thetas_rad.push_back(calibration::named_pose_rad(robot, pose));
    calibration::check_poses(robot, thetas_rad);
  } catch (const std::runtime_error& error) {
    throw launcher::BadInput("--poses: '" + list_of(poses) + "': " + error.what() +
                             (options.poses.empty() ? "; or name poses in the table, jig_poses" : ""));
  }
  const calibration::CalibrationResult result =
      calibration::calibrate(robot, read_all(options, simulated, poses, thetas_rad), calibration::today_utc());
  show(result, config::DriveNames(robot), options.json);
  if (!result.problems.empty()) return launcher::kExitFailure;
  if (!options.out_file.empty())
    launcher::write_output(options.out_file, calibration::calibration_json(result.calibration));
  return launcher::kExitOk;
}

}  // namespace liana::cli
