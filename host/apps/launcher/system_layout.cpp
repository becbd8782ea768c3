#include "host/apps/launcher/system_layout.hpp"

#include <net/if.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_like/cable/arm/static_load.hpp"
#include "host/api/server/welcome_size.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/mission_faults.hpp"
#include "host/apps/launcher/mission_steps.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/plan_file.hpp"
#include "host/apps/launcher/process.hpp"
#include "host/apps/launcher/runs.hpp"
#include "host/apps/launcher/start_pose.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/apps/launcher/validate_goals.hpp"
#include "host/base/install_paths/places.hpp"
#include "host/drives/calibration/calibration.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/serial_robot.hpp"
#include "host/planning/workspace/carry.hpp"

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFreeStep_s = "0.002";  // of a dry run's physics: a run takes half
constexpr const char* kRestWithin_s = "10";   // an arm whose cable broke may swing for longer; the report says so

std::string record_directory(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw BadInput("--record: '" + path + "': cannot be made: " + error.message() + "; give a directory you may write");
  if (!fs::is_empty(path)) throw BadInput("--record: '" + path + "': is not empty; give a new directory");
  return fs::absolute(path).string();
}

// The report is what a run is for: that it can be written is tried before anything starts.
void check_report_file(const std::string& path, const std::string& record_dir) {
  if (path.empty() || path == "-") return;
  const fs::path file = fs::weakly_canonical(path);
  if (!record_dir.empty() && file.parent_path() == fs::weakly_canonical(record_dir)) return;  // made, and tried, below
  check_output("--json", path);
}

// Every interface of a SocketCAN table must exist here and now.
void check_interfaces(const config::BusesConfig& buses) {
  if (buses.backend != "socketcan") return;
  const int fd = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, 1);
  if (fd < 0)
    throw BadInput("buses: '" + buses.name +
                   "': this kernel has no CAN; load can and can-raw, or take table embedded; see liana doctor");
  close(fd);
  for (const config::BusConfig& bus : buses.buses) {
    if (if_nametoindex(bus.name.c_str()) == 0) {
      throw BadInput("buses: '" + buses.name + "': interface " + bus.name +
                     " does not exist; make it (ip link add dev " + bus.name + " type vcan; ip link set " + bus.name +
                     " up) or take table embedded");
    }
  }
}

void check_virtual(const config::BusesConfig& buses) {
  if (buses.backend == "embedded") return;
  throw BadInput("--bus: '" + buses.name + "': a dry run moves nothing; allowed: a table with backend embedded");
}

void check_in_pose(const config::RobotConfig& robot, const std::string& pose) {
  try {
    calibration::check_tells_apart(robot, pose);
  } catch (const std::runtime_error& error) {
    throw BadInput("--in-pose: " + std::string(error.what()));
  }
}

std::string time_mode_of(const RunOptions& options, const config::BusesConfig& buses) {
  const bool wall_clock_only = buses.backend == "socketcan";
  if (options.time.empty()) return wall_clock_only ? "real" : "fast";
  if (wall_clock_only && options.time != "real") {
    throw BadInput("--time: '" + options.time + "': bus " + buses.name +
                   " is SocketCAN, which has no virtual time; allowed: real");
  }
  return options.time;
}

std::string interface_names(const config::BusesConfig& buses) {
  std::string names;
  for (const config::BusConfig& bus : buses.buses) names += (names.empty() ? "" : ",") + bus.name;
  return names;
}

void append(std::vector<std::string>& argv, const std::vector<std::string>& words) {
  argv.insert(argv.end(), words.begin(), words.end());
}

ProgramCall bus_call(const SystemLayout& plan) {
  ProgramCall call{"liana-bus",
                   {sibling_program("liana-bus"), "--socket", plan.bus_socket(), "--buses", plan.file("buses.json"),
                    "--time", plan.time_mode, "--stats", plan.file("bus_stats.json")}};
  if (plan.keeps_traffic) append(call.argv, {"--log", plan.directory});
  return call;
}

std::string expected_roles(const SystemLayout& plan, const RunOptions& options) {
  std::string roles = options.mission.empty() ? "client" : plan.is_serial ? "mission" : "mission,operator";
  return roles + (plan.has_recorder ? ",camera,archive" : ",camera");
}

ProgramCall daemon_call(const SystemLayout& plan, const RunOptions& options, bool embedded) {
  ProgramCall call{"lianad",
                   {sibling_program("lianad"), "--robot", plan.file("robot.json"), "--scene", plan.file("scene.json"),
                    "--buses", plan.file("buses.json"), "--api", plan.api_socket(), "--time", plan.time_mode,
                    "--physics", options.physics, "--expect", expected_roles(plan, options), "--events",
                    plan.events_file(), "--retract-path", plan.file("retract_path.bin")}};
  if (!options.mission.empty() || plan.has_recorder) append(call.argv, {"--commands", plan.commands_file()});
  if (plan.is_dry_run) append(call.argv, {"--verify-times", plan.verify_times_file()});
  if (!options.calibration.empty()) append(call.argv, {"--calibration", options.calibration});
  if (!options.in_pose.empty()) append(call.argv, {"--in-pose", options.in_pose});
  if (!options.people.fixtures.empty()) append(call.argv, {"--fixtures", options.people.fixtures});
  if (embedded) append(call.argv, {"--bus-socket", plan.bus_socket()});
  return call;
}

ProgramCall archive_call(const SystemLayout& plan) {
  ProgramCall call{"liana-archive",
                   {sibling_program("liana-archive"), "--api", plan.api_socket(), "--archive", plan.directory}};
  if (plan.keep_directory) append(call.argv, {"--record", plan.directory});
  return call;
}

ProgramCall bench_call(const SystemLayout& plan, const RunOptions& options, bool embedded) {
  ProgramCall call{"liana-bench",
                   {sibling_program("liana-bench"), "--robot", plan.file("robot.json"), "--scene",
                    plan.file("scene.json"), "--buses", plan.file("buses.json"), "--api", plan.api_socket(), "--arm",
                    options.arm, "--physics", options.true_physics.empty() ? options.physics : options.true_physics,
                    "--seed", std::to_string(options.seed), "--summary", plan.file("bench_summary.json")}};
  if (plan.keeps_traffic || plan.is_dry_run || options.is_lean) append(call.argv, {"--truth", plan.file("truth.bin")});
  const std::string& fixture = options.in_pose.empty() ? options.fixture : options.in_pose;
  append(call.argv, {"--start-pose", fixture.empty() ? options.start_pose : fixture});
  if (!fixture.empty()) append(call.argv, {"--jig"});
  if (!options.cross_wired.empty()) append(call.argv, {"--cross-wired", options.cross_wired});
  if (!options.faults.empty()) append(call.argv, {"--faults", options.faults});
  if (options.is_practice) append(call.argv, {"--practice", plan.practice_socket()});
  if (!options.scene_offset.empty()) append(call.argv, {"--scene-offset", options.scene_offset});
  if (options.gravity_share != 0.0) append(call.argv, {"--gravity", std::to_string(options.gravity_share)});
  if (options.linkage_error != 0.0) append(call.argv, {"--linkage-error", std::to_string(options.linkage_error)});
  if (!options.mission.empty()) append(call.argv, {"--rest-within", kRestWithin_s});
  if (plan.is_dry_run) append(call.argv, {"--free-step", kFreeStep_s});
  if (embedded) {
    append(call.argv, {"--bus-socket", plan.bus_socket()});
  } else {
    append(call.argv, {"--can", interface_names(plan.buses)});
  }
  return call;
}

// What only the bench can read is looked at by it before anything starts.
void ask_bench(const SystemLayout& plan) {
  std::vector<std::string> argv = plan.programs.back().argv;
  argv.emplace_back("--check");
  const Captured said = run_and_capture(argv);
  if (said.code == 0) return;
  discard(plan);
  const std::string prefix = "liana-bench: ";
  std::string problem = said.error.substr(said.error.starts_with(prefix) ? prefix.size() : 0);
  while (problem.ends_with('\n')) problem.pop_back();
  throw BadInput(problem);
}

ProgramCall operator_call(const SystemLayout& plan, const RunOptions& options) {
  std::string recordings;
  for (const Json& folder : plan.mission.at("recordings"))
    recordings += (recordings.empty() ? "" : ":") + folder.text();
  ProgramCall call{"liana-operator",
                   {sibling_program("liana-operator"), "--api", plan.api_socket(), "--recordings", recordings,
                    "--scene", plan.file("scene.json"), "--figures", plan.operator_file(), "--seed",
                    std::to_string(options.seed), "--lockstep"}};
  append(call.argv, operator_words(options.people));
  return call;
}

ProgramCall mission_call(const SystemLayout& plan, const RunOptions& options) {
  ProgramCall call{"liana-mission",
                   {sibling_program("liana-mission"), "run", "--api", plan.api_socket(), "--mission", options.mission,
                    "--report", plan.file("mission.json"), "--lockstep", "--progress"}};
  if (plan.is_dry_run) append(call.argv, {"--rehearsal"});
  return call;
}

bool is_plan(const RunOptions& options) { return options.mission.ends_with(".json"); }

// The table that a plan was made with, called by its own name; empty when the mission is no plan.
std::optional<TableText> table_of_plan(const RunOptions& options, const std::string& kind) {
  if (!is_plan(options)) return std::nullopt;
  const Json table = tables_of_plan(options.mission).member_or_null(kind);
  return TableText{table.value("name", kind), table.dump()};
}

// Fills in what a mission says it runs with: what is given goes before, and its bus belongs to its robot.
void take_tables_of_mission(RunOptions& options) {
  if (options.mission.empty() || is_plan(options)) return;
  const MissionTables own = tables_of_mission(options.mission);
  if (options.robot.empty()) options.robot = own.robot;
  if (options.scene.empty()) options.scene = own.scene;
  if (options.bus.empty() && options.robot == own.robot) options.bus = own.bus;
}

// What a run takes that is not told more: the robot and the scene of its plan, else those of the slit crossing.
TableText robot_of(const RunOptions& options) {
  if (!options.robot.empty()) return {options.robot, evaluate_table("robot", options.robot)};
  if (const auto planned = table_of_plan(options, "robot")) return *planned;
  return {kDefaultRobot, evaluate_table("robot", kDefaultRobot)};
}

TableText scene_of(const RunOptions& options, bool is_serial) {
  if (options.scene.empty() && !is_serial) {
    if (const auto planned = table_of_plan(options, "scene")) return *planned;
  }
  const std::string name = !options.scene.empty() ? options.scene : is_serial ? "none" : "panel_slit";
  return {name, evaluate_table("scene", name)};
}

Json mission_checked_with(const std::string& robot, const std::string& buses, const std::string& mission) {
  const std::string scratch = temporary_directory(), robot_file = scratch + "/robot.json",
                    bus_file = scratch + "/buses.json";
  try {
    write_output(robot_file, robot);
    write_output(bus_file, buses);
    Json description = check_mission(mission, robot_file, bus_file);
    fs::remove_all(scratch);
    return description;
  } catch (...) {
    fs::remove_all(scratch);
    throw;
  }
}

void note(const std::string& text) { std::fprintf(stderr, "note: %s\n", text.c_str()); }

void look_at_mission(const Json& mission, const config::SceneConfig& scene, bool is_simulated) {
  check_scene_parts(mission, scene);
  if (is_simulated) check_adapter_is_simulated(mission, scene);
  for (const Json& each : mission.value("notes", Json::array())) note(each.text());
}

// The bench has a payload for an arm whose drives follow torques only.
void check_payload_is_simulated(const RunOptions& options, const config::SceneConfig& scene,
                                bool is_torque_controlled) {
  if (!options.simulated_arm || !scene.payload || is_torque_controlled) return;
  throw BadInput(
      "--scene: " + scene.name + ": has a payload, and robot " + options.robot +
      " has no drives that follow torques: allowed is a robot with drives.mode = \"torque\", as macro_micro, or a "
      "scene without a payload");
}

// Poses of jigs are those of an arm that something else holds.
void check_poses_are_held(const std::string& name, const config::RobotConfig& robot) {
  if (!has_static_load(robot.table)) return;
  for (const auto& [pose, angles_deg] : robot.named_poses_deg) {
    if (std::find(robot.jig_poses.begin(), robot.jig_poses.end(), pose) != robot.jig_poses.end()) continue;
    if (const std::string why = workspace::refusal_of_pose(robot, pose); !why.empty())
      throw BadInput("--robot: " + name + ": " + why);
  }
}

// The start pose, too, is looked at: a robot that begins inside a body fails much later, and for no visible reason.
std::string check_options_of_cable_robot(const RunOptions& options, const std::string& text, const SystemLayout& plan) {
  const config::RobotConfig robot =
      checked([&] { return config::parse_robot(text, options.robot, options.physics, plan.buses); });
  check_payload_is_simulated(options, plan.scene, false);
  check_poses_are_held(options.robot, robot);
  if (!options.calibration.empty())
    checked([&] { return calibration::load_calibration(options.calibration, robot, calibration::today_utc()); });
  if (!options.in_pose.empty()) check_in_pose(robot, options.in_pose);
  check_cross_wired(options.cross_wired, static_cast<std::size_t>(robot.table.cable_count()));
  if (is_plan(options)) check_plan_file(options.mission, robot, plan.scene);
  const StartPose start = start_pose_of(
      robot, is_plan(options) && options.start_pose.empty() ? start_of_plan(options.mission) : options.start_pose);
  if (options.simulated_arm) check_start_is_free(robot, plan.scene, start);
  if (plan.mission.is_object()) {
    check_steps(plan.mission, robot, plan.scene, options.simulated_arm ? &start : nullptr);
    for (const std::string& text : look_at_tip_goals(plan.mission, robot, start.angles_deg)) note(text);
  }
  return options.simulated_arm ? start.text : "";
}

std::string check_options_of_serial_robot(const RunOptions& options, const std::string& text,
                                          const SystemLayout& plan) {
  const config::SerialRobotConfig robot =
      checked([&] { return config::parse_serial_robot(text, options.robot, plan.buses); });
  const auto refuse = [&](const char* option, bool given, const char* why) {
    if (given) throw BadInput(std::string(option) + ": robot " + options.robot + " has a serial arm: " + why);
  };
  refuse("--calibration", !options.calibration.empty(), "its encoders are absolute; leave it out");
  refuse("--in-pose", !options.in_pose.empty(), "its encoders are absolute; leave it out");
  refuse("--cross-wired", !options.cross_wired.empty(), "it has no cables to swap; leave it out");
  refuse("--gravity", options.gravity_share != 0.0, "its bench has no weight; leave it out");
  refuse("--fixtures", !options.people.fixtures.empty(), "no hand steers it yet; leave it out");
  refuse("--linkage-error", options.linkage_error != 0.0, "it has no linkage; leave it out");
  const auto is_unknown = [](const std::string& physics) { return !physics.empty() && physics != "nominal"; };
  refuse("--physics", is_unknown(options.physics), "its bench knows nominal only; leave it out");
  refuse("--true-physics", is_unknown(options.true_physics), "its bench knows nominal only; leave it out");
  refuse("--operator", options.people.who == "model", "no hand steers it yet; leave it out");
  refuse("mission", is_plan(options), "plans are for cable arms; give a mission");
  check_payload_is_simulated(options, plan.scene, config::is_torque_controlled(robot));
  const StartPose start = start_pose_of(robot, options.start_pose);
  if (options.simulated_arm) check_start_is_free(robot, plan.scene, start);
  return start.text;
}

void look_at_goals_of_serial_robot(const SystemLayout& plan, const RunOptions& options, const std::string& text) {
  const auto robot = checked([&] { return config::parse_serial_robot(text, options.robot); });
  check_steps(plan.mission, robot, plan.scene);
  const StartPose start = start_pose_of(robot, options.start_pose);
  for (const std::string& each : look_at_tip_goals(plan.mission, robot, start.angles_deg)) note(each);
}

void write_tables(const SystemLayout& plan, const std::string& robot, const std::string& scene,
                  const std::string& buses) {
  write_output(plan.file("robot.json"), robot);
  write_output(plan.file("scene.json"), scene);
  write_output(plan.file("buses.json"), buses);
}

// Where everything is written: the user's folder, one among the newest runs, or none that lasts.
RunFolder directory_of(const SystemLayout& plan, const RunOptions& options) {
  if (plan.keep_directory) return {record_directory(options.record_dir), nullptr};
  if (!plan.has_recorder) return {plan.socket_dir, nullptr};
  try {
    return make_run_folder(runs_folder());
  } catch (const std::runtime_error& error) {
    std::fprintf(
        stderr,
        "liana: this run will not be kept (%s): it goes to %s, which stays only if it fails; give --record DIR, "
        "or an XDG_STATE_HOME that can be written\n",
        error.what(), plan.socket_dir.c_str());
    return {plan.socket_dir, nullptr};
  }
}

constexpr const char* kFolderOfRun = "liana-run-";

}  // namespace

SystemLayout make_layout(const RunOptions& given) {
  RunOptions options = given;
  SystemLayout plan;
  remove_leftovers(kFolderOfRun);
  operator_words(options.people);  // refused before anything is made
  take_tables_of_mission(options);
  const TableText robot = robot_of(options);
  options.robot = robot.name;
  plan.robot = robot.name;
  plan.is_serial = checked([&] { return config::robot_kind(robot.json, robot.name); }) == "serial";
  const TableText buses = buses_of(robot.name, robot.json, options.bus);
  const TableText scene = scene_of(options, plan.is_serial);
  options.scene = scene.name;
  plan.buses = checked([&] { return config::parse_buses(buses.json, buses.name); });
  plan.scene = checked([&] { return config::parse_scene(scene.json, scene.name); });
  if (!plan.scene.camera || !plan.scene.contact)
    throw BadInput("--scene: '" + options.scene + "': has no " + (plan.scene.camera ? "contact" : "camera") +
                   ", which the bench needs; add it (docs/reference/formats.md)");
  checked([&] { api::require_fit_in_welcome(robot.json, scene.json, buses.json); });
  const bool has_mission = !options.mission.empty();
  if (has_mission && !plan.is_serial) plan.mission = mission_checked_with(robot.json, buses.json, options.mission);
  options.start_pose = plan.is_serial ? check_options_of_serial_robot(options, robot.json, plan)
                                      : check_options_of_cable_robot(options, robot.json, plan);
  if (has_mission && plan.is_serial) {
    plan.mission = mission_checked_with(robot.json, buses.json, options.mission);
    look_at_goals_of_serial_robot(plan, options, robot.json);
  }
  if (plan.mission.is_object()) look_at_mission(plan.mission, plan.scene, options.simulated_arm);
  if (!options.fault.empty()) options.faults = fault_file(plan.mission, options.fault);
  if (options.is_dry_run) check_virtual(plan.buses);
  check_interfaces(plan.buses);
  plan.time_mode = time_mode_of(options, plan.buses);
  plan.keep_directory = !options.record_dir.empty();
  plan.is_dry_run = options.is_dry_run;
  check_report_file(options.report_file, options.record_dir);
  const bool is_lean = plan.is_dry_run || options.is_lean;
  plan.has_recorder = (has_mission || options.is_session) && !is_lean;
  plan.keeps_traffic = !is_lean && (has_mission || !options.is_session);
  plan.socket_dir = temporary_directory();
  RunFolder folder = directory_of(plan, options);
  plan.directory = std::move(folder.path);
  plan.lock = std::move(folder.lock);
  write_tables(plan, robot.json, scene.json, buses.json);
  if (has_mission) keep_mission_files(plan.mission, plan.directory);
  const bool embedded = plan.buses.backend == "embedded";
  if (embedded) plan.programs.push_back(bus_call(plan));
  plan.programs.push_back(daemon_call(plan, options, embedded));
  if (plan.has_recorder) plan.programs.push_back(archive_call(plan));
  if (options.simulated_arm) {
    plan.programs.push_back(bench_call(plan, options, embedded));
    if (!options.faults.empty() || !options.scene_offset.empty()) ask_bench(plan);
  }
  if (!has_mission) return plan;
  if (!plan.is_serial) plan.programs.push_back(operator_call(plan, options));  // no device steers a serial arm yet
  plan.programs.push_back(mission_call(plan, options));
  return plan;
}

std::string temporary_directory() {
  remove_leftovers(kFolderOfRun);
  std::string name = (fs::temp_directory_path() / (std::string(kFolderOfRun) + "XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr)
    throw BadInput(name + ": a temporary directory cannot be made; free space there or set TMPDIR");
  static std::vector<FolderLock> held;  // until this process ends
  held.push_back(hold_new_folder(name, ""));
  return name;
}

void check_cross_wired(const std::string& list, std::size_t drives) {
  if (list.empty()) return;
  const auto drive_of = [drives](std::string_view word) -> std::optional<std::size_t> {
    std::size_t drive = 0;
    const char* end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, drive);
    if (error != std::errc() || stopped != end || drive < 1 || drive > drives) return std::nullopt;
    return drive;
  };
  const std::string_view words = list;
  const std::size_t comma = std::min(words.find(','), words.size());
  const auto first = drive_of(words.substr(0, comma));
  const auto second = drive_of(words.substr(std::min(comma + 1, words.size())));
  if (first && second && first != second) return;
  throw BadInput("--cross-wired: '" + list + "': allowed are two different drives from 1 to " + std::to_string(drives) +
                 ", e.g. 4,5");
}

void clean_up(const SystemLayout& plan, bool success) {
  std::error_code error;
  fs::remove(plan.api_socket(), error);
  fs::remove(plan.bus_socket(), error);
  fs::remove(plan.socket_dir + "/" + kLockFile, error);  // what is kept from here on is no leftover
  const bool is_temporary = plan.directory == plan.socket_dir;
  if (!is_temporary || success) fs::remove_all(plan.socket_dir, error);
  if (is_temporary || plan.keep_directory) return;
  if (success) keep_what_lasts(plan.directory);
  remove_oldest_runs(runs_folder());
}

void discard(const SystemLayout& plan) {
  std::error_code error;
  fs::remove_all(plan.socket_dir, error);
  if (!plan.keep_directory) fs::remove_all(plan.directory, error);
}

}  // namespace liana::launcher
