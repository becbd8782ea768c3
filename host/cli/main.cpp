// `liana`: the command line. This file holds the options and the exit codes; every command has a file of its own.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <span>

#include "host/cli/arguments.hpp"
#include "host/cli/commands.hpp"
#include "host/desk/desk.hpp"
#include "host/json/json.hpp"
#include "host/places/places.hpp"
#include "host/system/errors.hpp"
#include "host/system/interrupt.hpp"
#include "host/system/output.hpp"

using namespace liana::cli;

namespace {

using liana::system::ExitCode;
using Action = std::function<int()>;

constexpr const char* kLuaDir = "--lua-dir";

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 failed, 2 bad input, 3 inverse kinematics did not converge or there is no plan,\n"
    "130 interrupted; one message on standard error says what, with --json standard output has it, too.\n"
    "Angles are degrees where the option says deg, lengths metres, poses in the base frame.";

// Adds a subcommand and remembers what to do when it is chosen.
template <typename Options>
CLI::App* add(CLI::App& app, Action& action, const char* name, const char* text, Options& options,
              int (*command)(const Options&)) {
  CLI::App* sub = app.add_subcommand(name, text);
  sub->callback([&action, &options, command] { action = [&options, command] { return command(options); }; });
  return sub;
}

// A number from `low` to `high`; CLI::Range lets NaN through.
CLI::Validator within(double low, double high) {
  const auto problem = [low, high](const std::string& text) -> std::string {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return "";
    char allowed[64];
    std::snprintf(allowed, sizeof allowed, "%g to %g", low, high);
    return "'" + text + "': allowed: " + allowed;
  };
  return {problem, ""};
}

void add_seed(CLI::App& sub, std::uint64_t& seed, const std::string& what) {
  sub.add_option_function<std::string>(
         "--seed", [&seed](const std::string& text) { seed = parse_seed("--seed", text); },
         what + "; 0 to 9007199254740991")
      ->default_str("1");
}

void add_kinematics(CLI::App& app, Action& action, PoseOptions& pose, IkOptions& ik) {
  CLI::App* sub = add(app, action, "pose", "tip pose, segment ends, Jacobian and cable lengths of joint angles", pose,
                      pose_command);
  sub->add_option("--robot", pose.robot, "robot table: a name under lua/robots or a file")->capture_default_str();
  sub->add_option("--theta-deg", pose.theta_deg, "joint angles t1,t2,... (pitch, yaw per segment)")->required();
  sub->add_option("--scene", pose.scene,
                  "scene: which segments its slit wants planar, where they begin, what their yaws may be");
  sub->add_flag("--json", pose.json, "print JSON");

  sub = add(app, action, "ik", "joint angles of a tip pose (goal solver)", ik, ik_command);
  sub->add_option("--robot", ik.robot, "robot table: a name under lua/robots or a file")->capture_default_str();
  sub->add_option("--from-deg", ik.from_deg, "joint angles to start from")->required();
  sub->add_option("--tip", ik.tip, "goal x,y,z,qw,qx,qy,qz")->required();
  sub->add_option("--hold", ik.hold,
                  "joint angles held still, e.g. 7,9 or 7=0.5,9 (deg; at --from-deg where no value is given)");
  sub->add_option("--control-point", ik.control_points,
                  "node target NODE:x,y,z[:WEIGHT]; may be repeated; WEIGHT is 1 for the arm's middle node and 0.25 "
                  "for others where not given")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_flag("--json", ik.json, "print JSON");
}

void add_reach(CLI::App& app, Action& action, ReachOptions& reach) {
  CLI::App* sub =
      add(app, action, "reach", "where tip or node can go; conditioning and limits along a path", reach, reach_command);
  sub->add_option("--robot", reach.robot, "robot table: a name under lua/robots or a file")->capture_default_str();
  sub->add_option("--scene", reach.scene, "scene table drawn to scale; takes nothing away from the region");
  sub->add_option("--hold", reach.hold,
                  "joint angles held still, e.g. 7,9 or 7=0.5,9 (deg; at --from-deg or 0 where no value is given)");
  sub->add_option("--from-deg", reach.from_deg, "joint angles that are drawn, or where the path begins");
  sub->add_option("--to-deg", reach.to_deg, "joint angles where the path ends");
  sub->add_option("--path", reach.path, "JSON file with waypoints_deg, as plan --json prints it");
  sub->add_option("--node", reach.node,
                  "node (the end of that segment) whose region is wanted; the tip where not given");
  sub->add_option("--samples", reach.samples, "poses drawn")->capture_default_str();
  add_seed(*sub, reach.seed, "of the poses drawn");
  sub->add_option("--svg", reach.svg_file, "write the picture to this file");
  sub->add_flag("--json", reach.json, "print JSON");
}

void add_verify(CLI::App& app, Action& action, VerifyOptions& verify) {
  CLI::App* sub =
      add(app, action, "verify", "whether a straight motion of the joints would be released, and what it leaves",
          verify, verify_command);
  sub->add_option("--robot", verify.robot, "robot table: a name under lua/robots or a file")->capture_default_str();
  sub->add_option("--scene", verify.scene, "scene table: a name under lua/scenes or a file")->capture_default_str();
  sub->add_option("--from-deg", verify.from_deg, "joint angles where the arm stands")->required();
  sub->add_option("--to-deg", verify.to_deg, "joint angles where it is told to stop")->required();
  sub->add_option("--duration", verify.duration_s, "how long that takes, s; T_c to 600")->required();
  sub->add_flag("--json", verify.json, "print JSON");
}

void add_plan(CLI::App& app, Action& action, PlanOptions& plan) {
  CLI::App* sub = add(app, action, "plan", "joint angles or a tip pose reached past the scene (offline planner)", plan,
                      plan_command);
  sub->add_option("--robot", plan.robot, "robot table: a name under lua/robots or a file")->capture_default_str();
  sub->add_option("--scene", plan.scene, "scene table: a name under lua/scenes, a file, or none")
      ->capture_default_str();
  sub->add_option("--from-deg", plan.from_deg, "joint angles to start from")->required();
  sub->add_option("--to-deg", plan.to_deg, "goal as joint angles");
  sub->add_option("--tip", plan.tip, "goal as tip pose x,y,z,qw,qx,qy,qz");
  sub->add_option("--follow", plan.follow,
                  "follow the leader: the tip along the curve of a JSON file (points_m), the body after it; or slit: "
                  "through the scene's slit "
                  "to the goal");
  sub->add_option("--hold", plan.hold,
                  "joint angles held, e.g. 7,9 or 7=0.5,9 (deg); one with another value than at the start is there "
                  "after a third of the way");
  sub->add_option(
      "--planar", plan.planar,
      "segments whose pitch is 0 from a share of the way on, e.g. 5@0.4,4@0.7; all the way where no share is given");
  sub->add_option("--control-point", plan.control_points,
                  "node target NODE:x,y,z[:WEIGHT]; may be repeated; WEIGHT is 1 for the arm's middle node and 0.25 "
                  "for others where not given")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--waypoints", plan.waypoints, "waypoints with both ends, 20 where not given; 1: only the end pose");
  sub->add_option("--margin", plan.margin_m, "least clearance of every link from every obstacle, m")
      ->capture_default_str();
  sub->add_option("--max-step-deg", plan.max_step_deg,
                  "most that an angle changes between waypoints; 80 / (waypoints - 1) where not given");
  sub->add_option("--iterations", plan.max_iterations,
                  "of the solver in each round, 300 where not given; not with --follow");
  sub->add_option("--out", plan.out_file, "keep the plan with its inputs in this file, JSON");
  sub->add_flag("--json", plan.json, "print JSON");
}

// What a mission is run with, on the arm or in a dry run.
void add_mission_options(CLI::App& sub, liana::system::RunOptions& run) {
  sub.add_option("mission", run.mission, "a name under lua/missions, a file, or a plan (JSON of liana plan --out)")
      ->required();
  sub.add_option(
      "--robot", run.robot,
      "robot table: a name under lua/robots or a file; where not given that of a plan, zhu2022 for a mission");
  sub.add_option("--scene", run.scene,
                 "scene table: a name under lua/scenes or a file; where not given that of a plan, for a mission "
                 "panel_slit, for a serial arm none");
  sub.add_option("--bus", run.bus,
                 "bus table: a name under lua/buses or a file; where not given embedded_ROBOT if there is such a "
                 "table, else one for the robot's drives on simulated buses");
  sub.add_option("--start-pose", run.start_pose,
                 "where the simulated arm begins: a named pose of the robot, or all its angles, t1,t2,... deg; where "
                 "not given the table's start_pose, else prepare or zero");
  sub.add_option("--physics", run.physics, "nominal, ideal or worn")
      ->capture_default_str()
      ->check(CLI::IsMember({"nominal", "ideal", "worn"}));
  sub.add_option("--calibration", run.calibration,
                 "what liana calibrate wrote; the robot table's values where not given");
  sub.add_option("--faults", run.faults,
                 "to try it out: faults of the simulated drives, cables and camera (docs/hil.md)")
      ->check(CLI::ExistingFile);
  sub.add_option("--true-physics", run.true_physics,
                 "to try it out: nominal, ideal or worn; the simulated arm's friction, where it is not what lianad is "
                 "told with --physics")
      ->check(CLI::IsMember({"nominal", "ideal", "worn"}));
  sub.add_option("--scene-offset", run.scene_offset,
                 "to try it out: MM,DEG, e.g. 10,1; the simulated scene is so far from where its table has it, in a "
                 "direction drawn from the seed");
  sub.add_option("--gravity", run.gravity_share,
                 "to try it out: share of the simulated arm's weight that its counterweights leave; down is -z of the "
                 "base frame")
      ->check(within(0.0, 1.0));
  sub.add_option("--linkage-error", run.linkage_error,
                 "to try it out: share by which the simulated joints of a segment bend unevenly at most, 0.01 is 1 %, "
                 "drawn from the seed")
      ->check(within(0.0, 0.5));
  sub.add_option("--json", run.report_file, "write the report as JSON to this file (- = standard output)");
  add_seed(sub, run.seed, "seed of everything random: hand, start pose, bench parameters, camera");
}

void add_run(CLI::App& app, Action& action, liana::system::RunOptions& run) {
  CLI::App* sub = add(app, action, "run", "start the whole system and run a mission", run, run_command);
  add_mission_options(*sub, run);
  sub->add_option("--time", run.time, "fast, paced or real; fast where nothing is said, real on SocketCAN")
      ->check(CLI::IsMember({"fast", "paced", "real"}));
  sub->add_option("--in-pose", run.in_pose,
                  "named pose in which the arm lies in its fixture: unless every cable says so, it is not enabled");
  sub->add_option("--cross-wired", run.cross_wired,
                  "to try it out: two drives of the simulated arm, e.g. 3,4, have each other's cable");
  sub->add_option("--record", run.record_dir, "keep recording, logs, bus traffic and report in this directory");
  sub->add_flag("--console", run.has_console, "show it in a browser while it runs; the address goes to standard error");
}

void add_gateway_options(CLI::App& sub, liana::system::GatewayOptions& gateway) {
  sub.add_option(
      "--listen", gateway.listen,
      "ADDR:PORT; where not given 127.0.0.1:8765, or a free port where that is taken; beyond this machine it "
      "takes --token-file, --cert and --key");
  sub.add_option("--token-file", gateway.token_file,
                 "lines NAME ROLE TOKEN, roles watch, operate, administer; mode 0600 (docs/console-protocol.md)");
  sub.add_option("--cert", gateway.certificate, "certificate for TLS, PEM");
  sub.add_option("--key", gateway.key, "its key, PEM");
}

void add_console(CLI::App& app, Action& action, ConsoleOptions& console) {
  CLI::App* sub = add(app, action, "console", "the arm in a browser: of a running system, or a simulated one", console,
                      console_command);
  sub->add_option("--api", console.api,
                  "API socket of a lianad; where not given, that of the one running system, or a simulated arm");
  sub->add_flag("--simulate", console.simulate, "start a simulated arm, also where a system runs");
  sub->add_option("--robot", console.run.robot,
                  "of the simulated arm: a name under lua/robots or a file; zhu2022 where not given");
  sub->add_option("--scene", console.run.scene,
                  "of the simulated arm: a name under lua/scenes or a file; panel_slit where not given, for a serial "
                  "arm none");
  sub->add_option("--bus", console.run.bus, "of the simulated arm: an embedded bus table");
  sub->add_option("--start-pose", console.run.start_pose,
                  "of the simulated arm: a named pose of the robot, or all its angles, t1,t2,... deg");
  sub->add_option("--physics", console.run.physics, "of the simulated arm: nominal, ideal or worn")
      ->capture_default_str()
      ->check(CLI::IsMember({"nominal", "ideal", "worn"}));
  sub->add_option("--calibration", console.run.calibration, "of the simulated arm: what liana calibrate wrote");
  add_seed(*sub, console.run.seed, "of the simulated arm");
  add_gateway_options(*sub, console.gateway);
  sub->add_flag("--json", console.json, "print JSON");
}

void add_view(CLI::App& app, Action& action, ViewOptions& view) {
  CLI::App* sub =
      add(app, action, "view", "the page of a run: what happened, in one file for a browser", view, view_command);
  CLI::Option* run = sub->add_option(
      "run", view.run, "a folder, or the name of one of the newest runs; where not given, the one that ended last");
  CLI::Option* out = sub->add_option("--out", view.out_file, "write the page here, not as page.html beside the run");
  sub->add_flag("--live", view.live, "the console of a running system instead")->excludes(run)->excludes(out);
  sub->add_option("--api", view.api, "with --live: API socket of a lianad")->needs("--live");
  sub->add_flag("--json", view.json, "print JSON");
}

void add_check(CLI::App& app, Action& action, liana::system::RunOptions& check) {
  CLI::App* sub = add(app, action, "check", "dry run of a mission: what its steps leave of the limits, what is refused",
                      check, check_command);
  add_mission_options(*sub, check);
}

void add_calibrate(CLI::App& app, Action& action, CalibrateOptions& calibrate) {
  CLI::App* sub =
      add(app, action, "calibrate", "zeros, drums, directions and wiring of all drives, with the arm in fixtures",
          calibrate, calibrate_command);
  sub->add_option("--robot", calibrate.robot, "robot table")->capture_default_str();
  sub->add_option("--bus", calibrate.bus, "bus table; where not given as for liana run");
  sub->add_option("--poses", calibrate.poses,
                  "named poses of the robot for which there are fixtures, two or more; where not given the table's "
                  "fixture_poses, else zero,fixture,prepare");
  sub->add_option("--physics", calibrate.physics, "nominal, ideal or worn")
      ->capture_default_str()
      ->check(CLI::IsMember({"nominal", "ideal", "worn"}));
  sub->add_option("--cross-wired", calibrate.cross_wired,
                  "to try it out: two drives of the simulated arm, e.g. 3,4, have each other's cable");
  sub->add_option("--out", calibrate.out_file,
                  "write the calibration to this file, for lianad --calibration and liana run --calibration");
  sub->add_flag(
      "--friction", calibrate.friction,
      "measure the cables' friction instead: the arm is enabled and each segment turned by 3 deg to and fro, for "
      "about three minutes; needs 0.5 m of room around it");
  sub->add_option("--calibration", calibrate.calibration, "with --friction: the calibration that it is added to");
  add_seed(*sub, calibrate.seed, "of the simulated arm");
  sub->add_flag("--json", calibrate.json, "print JSON");
}

void add_latency(CLI::App& app, Action& action, LatencyOptions& latency) {
  CLI::App* sub =
      add(app, action, "latency", "how late this machine wakes lianad's real-time thread, and how long its ticks take",
          latency, latency_command);
  sub->add_option("--robot", latency.robot, "robot table: a name under lua/robots or a file; zhu2022 where not given");
  sub->add_option("--rate", latency.rate_hz, "250 or 500 Hz")->default_str("250");
  sub->add_option_function<std::string>(
         "--seconds",
         [&latency](const std::string& text) {
           latency.seconds = parse_number_in("--seconds", text, 0.1, 86400.0, "s");
         },
         "how long to measure; 0.1 to 86400")
      ->default_str("10");
  sub->add_option(
      "--buses", latency.buses,
      "bus table, in place of the embedded one of the rate or the robot: vcan, or a table of your interfaces");
  sub->add_option("--arm", latency.arm,
                  "the bench's arm model: full, or light (no inertia, contact or cable friction) for slow machines")
      ->capture_default_str()
      ->check(CLI::IsMember({"full", "light"}));
  sub->add_flag("--json", latency.json, "print JSON");
}

void add_faults(CLI::App& app, Action& action, FaultsOptions& faults) {
  CLI::App* sub = add(app, action, "faults", "every fault number: how it is detected, what it stops, what to do",
                      faults, faults_command);
  sub->add_option("--robot", faults.robot, "robot table whose tick counts")->capture_default_str();
  sub->add_flag("--refusals", faults.refusals, "error codes M_e of verification in place of faults");
  sub->add_flag("--markdown", faults.markdown, "print the table of docs/faults.md, or of docs/refusals.md");
  sub->add_flag("--json", faults.json, "print JSON");
}

void add_mission(CLI::App& app, Action& action, MissionOptions& mission) {
  CLI::App* sub = add(app, action, "mission", "tells the mission that runs how to go on", mission, mission_command);
  sub->add_option("command", mission.command,
                  "pause: the arm holds; resume: go on; step: one step, then a pause; confirm: what the step asks for; "
                  "abort: end it")
      ->required()
      ->check(CLI::IsMember({"pause", "resume", "step", "confirm", "abort"}));
  sub->add_option("--api", mission.api, "API socket of the lianad; where not given, that of the one running system");
  sub->add_flag("--json", mission.json, "print JSON");
}

void add_commands(CLI::App& app, Action& action, CommandsOptions& commands) {
  CLI::App* sub = add(app, action, "commands", "what became of the commands of a run: verdicts, margins, refusals",
                      commands, commands_command);
  sub->add_option("run", commands.run,
                  "a folder, the name of one of the newest runs, or a commands.txt; where not given, the newest run");
  sub->add_option_function<std::string>(
         "--last",
         [&commands](const std::string& text) {
           commands.last = static_cast<std::uint32_t>(parse_whole("--last", text, 1, 1000000000));
         },
         "so many of the newest; 1 to 1000000000")
      ->default_str("20");
  sub->add_flag("--refused", commands.refused, "only refused ones");
  sub->add_flag("--margins", commands.margins, "what they all left of the limits, in place of a list");
  sub->add_flag("--json", commands.json, "print JSON, one line for each command");
}

void add_arm_time(CLI::App& sub, const char* option, double& value_s) {
  sub.add_option_function<std::string>(
      option,
      [&value_s, option](const std::string& text) {
        value_s = parse_number_in(option, text, 0.0, kLatestArmTime_s, "s of arm time");
      },
      "arm time, s; 0 to 1e9");
}

void add_log(CLI::App& app, Action& action, LogOptions& log) {
  CLI::App* all = app.add_subcommand("log", "what the archives of runs hold (docs/archive.md)");
  all->require_subcommand(1);
  CLI::App* list = add(*all, action, "list", "the newest runs: begin, outcome, length, size", log, log_list_command);
  CLI::App* show = add(*all, action, "show", "events, refusals, faults, steps of a run", log, log_show_command);
  CLI::App* verify =
      add(*all, action, "verify", "whether an archive is whole, and what it holds", log, log_verify_command);
  CLI::App* exported = add(*all, action, "export", "a run for other tools: CSV, MCAP (Foxglove), candump, ticks", log,
                           log_export_command);
  for (CLI::App* sub : {show, exported, verify})
    sub->add_option("run", log.run, "a folder, or the name of one of the newest runs; the newest where not given");
  for (CLI::App* sub : {show, exported}) {
    add_arm_time(*sub, "--from", log.from_s);
    add_arm_time(*sub, "--to", log.to_s);
  }
  exported->add_option("--csv", log.csv, "file for telemetry as a table");
  exported->add_option("--mcap", log.mcap, "file for the arm in its scene, angles, events, as Foxglove shows them");
  exported->add_option("--candump", log.candump, "file for the traffic of all buses");
  exported->add_option("--ticks", log.ticks, "folder for every control tick, as --record writes it: liana replay");
  for (CLI::App* sub : {list, show, exported, verify}) sub->add_flag("--json", log.json, "print JSON");
}

void add_client(CLI::App& app, Action& action, const char* name, const char* text, ClientOptions& client,
                int (*command)(const ClientOptions&), bool one = false) {
  CLI::App* sub = add(app, action, name, text, client, command);
  sub->add_option("--api", client.api,
                  one ? "API socket of the lianad; where not given, that of the one running system of this user "
                        "(several are refused)"
                      : "API socket of one lianad; where not given, all running systems of this user");
  sub->add_flag("--json", client.json,
                one ? "print JSON, also when nothing could be cleared" : "print JSON, one line for each system");
}

// The options and commands of `app` and of all commands below it.
std::vector<CommandHelp> help_of(const CLI::App& app, const std::string& path) {
  std::vector<CommandHelp> all{{path, {}}};
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    all.front().words.push_back({sub->get_name(), sub->get_description()});
    const std::vector<CommandHelp> below = help_of(*sub, path + " " + sub->get_name());
    all.insert(all.end(), below.begin(), below.end());
  }
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      all.front().words.push_back({"--" + name, option->get_description()});
  }
  return all;
}

// Options that stand before the command: for every command the same.
void add_global(CLI::App& app) {
  app.set_version_flag("--version", "liana " LIANA_VERSION, "say which version");
  app.add_option_function<std::string>(
      kLuaDir, [](const std::string& folder) { liana::places::search_first(kLuaDir, folder); },
      "before the command: a folder of tables and missions that is searched first (docs/installing.md)");
}

void add_jog(CLI::App& sub, JogOptions& jog) {
  sub.add_option("--by", jog.by, "how far, in --unit, of either sign; at most --most")->required();
  sub.add_option("--speed", jog.speed, "how fast, in --unit a second; at most --most-speed; not given: 0.05 turns/s");
  sub.add_option("--unit", jog.unit, "turns (of the motor), deg, or mm")->capture_default_str();
  sub.add_option("--mm-per-turn", jog.mm_per_turn, "for mm: the way of one turn of the motor");
  sub.add_option("--counts-per-turn", jog.counts_per_turn, "of the encoder, for drives without 608F");
  sub.add_option("--most", jog.most, "longest way, turns of the motor; to 100")->capture_default_str();
  sub.add_option("--most-speed", jog.most_speed, "fastest, turns/s; to 100")->capture_default_str();
  sub.add_option("--torque", jog.torque, "at most, permille of the rated torque (6072); 10 to 1000")
      ->capture_default_str();
  sub.add_flag("--yes", jog.yes, "move without asking for the word at the terminal");
  sub.add_flag("--clear", jog.clear, "let the drive forget a fault from before");
}

void add_drive(CLI::App& app, Action& action, DriveOptions& drive) {
  CLI::App* all = app.add_subcommand("drive", "one motor on a desk, before there is a robot table (docs/drives.md)");
  all->require_subcommand(1);
  CLI::App* scan = add(*all, action, "scan", "which nodes answer, and what they are", drive, drive_scan_command);
  CLI::App* read = add(*all, action, "read", "an object of a drive", drive, drive_read_command);
  CLI::App* write = add(*all, action, "write", "give an object a value, and read it back", drive, drive_write_command);
  CLI::App* watch = add(*all, action, "watch", "an object, again and again", drive, drive_watch_command);
  CLI::App* check =
      add(*all, action, "check", "everything that a boot would refuse; reads only", drive, drive_check_command);
  CLI::App* jog =
      add(*all, action, "jog", "turn a motor a short way: enable, move, stop, disable", drive, drive_jog_command);
  for (CLI::App* sub : {scan, read, write, watch, check, jog}) {
    sub->add_option("--can", drive.can, "SocketCAN interface, e.g. can0");
    sub->add_option("--bitrate", drive.bitrate, "of --can, bit/s; 10000 to 1000000")->capture_default_str();
    sub->add_option("--bus", drive.bus, "bus table in place of --can: a name under lua/buses or a file");
    sub->add_option("--bus-socket", drive.bus_socket, "socket of liana-bus, for a table with the embedded backend");
    sub->add_option("--time", drive.time, "of that liana-bus: fast, paced or real")->capture_default_str();
    sub->add_flag("--json", drive.json, "print JSON");
  }
  scan->add_option("--first", drive.first, "least node id, 1 to 126")->capture_default_str();
  scan->add_option("--last", drive.last, "largest node id, to 126")->capture_default_str();
  for (CLI::App* sub : {read, write, watch, check, jog})
    sub->add_option("--node", drive.node, "node id of the drive, 1 to 126; has to be said");
  for (CLI::App* sub : {read, write, watch})
    sub->add_option("object", drive.object, "index, or index:sub-index, e.g. 6064 or 1018:1")->required();
  write->add_option("value", drive.value, "whole number that fits in --bits")->required();
  write->add_option("--bits", drive.bits, "size of the object: 8, 16 or 32")->capture_default_str();
  watch->add_option("--rate", drive.rate_hz, "how often, Hz; 0.1 to 20")->capture_default_str();
  watch->add_option("--seconds", drive.seconds, "how long; 0.1 to 86400")->capture_default_str();
  CLI::Option* robot = check->add_option(
      "--robot", drive.robot, "in place of --node: all drives of a robot table, of the types that the bus table says");
  robot->excludes(check->get_option("--node"));
  for (CLI::App* sub : {check, jog})
    sub->add_option("--type", drive.type, "drive type: a name under lua/drives or a file")->capture_default_str();
  robot->excludes(check->get_option("--type"));
  add_jog(*jog, drive.jog);
}

void add_robot(CLI::App& app, Action& action, ExportOptions& exported, RobotCheckOptions& checked,
               RobotNewOptions& made) {
  CLI::App* robot = app.add_subcommand("robot", "robot tables");
  robot->require_subcommand(1);
  CLI::App* sub = add(*robot, action, "export", "a robot table as canonical JSON", exported, export_command);
  sub->add_option("robot", exported.robot, "a name under lua/robots or a file")->capture_default_str();
  sub->add_option("--robot", exported.robot, "the same as an option");
  sub->add_option("--out", exported.file, "file to write; standard output where not given");
  sub->add_flag("--json")->description("the output is JSON with or without it");

  sub = add(*robot, action, "check", "what of a robot fits: capacity, bus load, workspace, tensions, holes, fixtures",
            checked, robot_check_command);
  sub->add_option("robot", checked.robot, "a name under lua/robots or a file")->capture_default_str();
  sub->add_option("--robot", checked.robot, "the same as an option");
  sub->add_option("--bus", checked.bus, "bus table; where not given as for liana run");
  sub->add_option("--svg", checked.svg_file, "draw the discs' holes and the cables' routing to this file");
  sub->add_flag("--json", checked.json, "print JSON");

  sub = add(*robot, action, "new", "write a commented robot table from a few answers", made, robot_new_command);
  sub->add_option("name", made.name, "name of the robot: small letters, digits, _")->required();
  sub->add_option("--out", made.file, "file to write; NAME.lua where not given");
  sub->add_option("--segments", made.segments, "segments that bend by themselves, 1 to 8");
  sub->add_option("--modules", made.modules, "universal joints in each, 1 to 16");
  sub->add_option("--module-length", made.module_length_m, "from one joint to the next, 0.005 to 1 m");
  sub->add_option("--radius", made.radius_m, "of the discs, 0.002 to 0.5 m");
  sub->add_option("--cables", made.cables, "that end in each segment, 3 or 4");
  sub->add_option("--theta-limit", made.theta_limit_deg, "most that a joint turns about each axis, 1 to 60 deg");
}

void add_tools(CLI::App& app, Action& action, ReplayOptions& replay, bool& doctor_json, std::string& shell) {
  CLI::App* sub = add(app, action, "replay", "run a recording through the core again and compare every output", replay,
                      replay_command);
  sub->add_option("directory", replay.directory,
                  "what `liana run --record` wrote: a folder, or the name of one of the newest runs")
      ->required();
  sub->add_flag("--json", replay.json, "print JSON");

  sub = app.add_subcommand("doctor", "what this host can and cannot do, and what to do about it");
  sub->add_flag("--json", doctor_json, "print JSON");
  sub->callback([&] { action = [&] { return doctor_command(doctor_json); }; });

  sub = app.add_subcommand("completion", "tab completion: source <(liana completion bash)");
  sub->add_option("shell", shell, "bash or zsh; or robots, scenes, buses, missions: the names that there are")
      ->capture_default_str();
  sub->callback([&] { action = [&] { return completion_command(shell, help_of(app, "liana")); }; });
  app.add_subcommand("help", "this text, or `liana help COMMAND`");
}

// `--hold= --json` must not read `--json` as the value of --hold, and an unset shell variable must not mean
// "everything" or "nothing".
void check_values(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word.empty()) throw liana::system::BadInput("an argument is empty (''); give a value, or leave the option out");
    if (word.starts_with("--") && word.ends_with('='))
      throw liana::system::BadInput(word + ": no value after =; give one, or leave the option out");
  }
}

// An option that its command does not know is named, whatever else is missing. `before`: the command's words, each with
// a blank.
void check_options(const CLI::App& command, const std::string& before, std::span<const std::string> words) {
  for (const std::string& word : words) {
    if (word == "--") return;
    const std::string option = word.substr(0, word.find('='));
    if (word.starts_with("--") && option != "--help" && command.get_option_no_throw(option) == nullptr)
      throw liana::system::BadInput(option + ": liana " + before + "has no such option; see liana " + before +
                                    "--help");
  }
}

// A word in place of a command that is none gets the list of those that are; `before` are the words before it.
void check_command(const CLI::App& app, const std::string& before, std::span<const std::string> words) {
  std::string names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + sub->get_name();
    if (!words.empty() && words.front() == sub->get_name())
      return check_command(*sub, before + words.front() + " ", words.subspan(1));
  }
  if (names.empty() || (!words.empty() && words.front().starts_with('-'))) return check_options(app, before, words);
  const std::string problem = words.empty() ? "no command given" : "'" + before + words.front() + "': no such command";
  throw liana::system::BadInput(problem + "; liana " + before + "knows: " + names + "; see liana help");
}

// The words from the command on: only --lua-dir may stand before it.
std::span<const std::string> after_global_options(std::span<const std::string> words) {
  while (!words.empty()) {
    if (words.front().starts_with(std::string(kLuaDir) + "=")) {
      words = words.subspan(1);
    } else if (words.front() == kLuaDir && words.size() > 1) {
      words = words.subspan(2);
    } else {
      return words;
    }
  }
  return words;
}

// `help` and `help COMMAND` are `--help` and `COMMAND --help`.
std::vector<std::string> arguments_of(const CLI::App& app, std::vector<std::string> words) {
  const auto command = words.end() - std::ssize(after_global_options(words));
  if (command != words.end() && *command == "help") {
    words.erase(command);
    words.push_back("--help");
  }
  check_values(words);
  check_command(app, "", after_global_options(words));
  std::reverse(words.begin(), words.end());  // as CLI11 wants it
  return words;
}

struct Chosen {
  const CLI::App* command;
  std::string words;  // of it, each after a blank
};

// The command that was being read.
Chosen chosen(const CLI::App& app) {
  Chosen found{&app, ""};
  while (!found.command->get_subcommands().empty()) {
    found.command = found.command->get_subcommands().front();
    found.words += " " + found.command->get_name();
  }
  return found;
}

// An option at the end of the line, or before another one, whose value was forgotten: what its value may be is said.
std::string missing_value_text(const CLI::App& app, const std::string& error) {
  const auto [command, words] = chosen(app);
  const std::string name = error.substr(0, error.find(':'));
  const CLI::Option* option = name.starts_with("--") ? command->get_option_no_throw(name) : nullptr;
  const std::string see = "; see liana" + words + " --help";
  return option == nullptr ? error + see : name + ": no value given; allowed: " + option->get_description() + see;
}

// A word that the command has no place for.
std::string extra_word_text(const CLI::App& app) {
  const std::string command = chosen(app).words;
  const std::vector<std::string> words = app.remaining(true);
  return "'" + (words.empty() ? "" : words.front()) + "': liana" + command +
         " takes no such word; leave it out, or see liana" + command + " --help";
}

// Whether standard output takes JSON: with --json; of `run` and `check`, whose --json wants a file, where that is -.
bool prints_json(std::span<const std::string> words) {
  words = after_global_options(words);
  const auto json = std::find_if(words.begin(), words.end(),
                                 [](const std::string& word) { return word == "--json" || word == "--json=-"; });
  if (json == words.end()) return false;
  const bool wants_file = words.front() == "run" || words.front() == "check";
  return !wants_file || *json == "--json=-" || (json + 1 != words.end() && json[1] == "-");
}

// How a command ends that has no answer: one message on standard error, and with --json that as JSON in the answer's
// place. Returns the code.
class Refusal {
 public:
  explicit Refusal(bool as_json) : as_json_(as_json) {}
  int operator()(ExitCode code, const std::string& text) const {
    std::fprintf(stderr, "liana: %s\n", text.c_str());
    if (as_json_)
      std::printf("%s\n", liana::Json{{"error", {{"exit_code", int{code}}, {"text", text}}}}
                              .dump(-1, liana::Json::BadUtf8::kReplace)
                              .c_str());
    return code;
  }

 private:
  bool as_json_;
};

int perform(const Action& action, const Refusal& refuse) {
  try {
    return action();
  } catch (const liana::system::BadInput& error) {
    return refuse(ExitCode::kExitBadInput, error.what());
  } catch (const liana::system::Interrupted& error) {
    std::fprintf(stderr, "liana: %s\n", error.what());
    return ExitCode::kExitInterrupted;
  } catch (const liana::desk::DeskInterrupted& error) {
    std::fprintf(stderr, "liana: %s\n", error.what());
    return ExitCode::kExitInterrupted;
  } catch (const std::exception& error) {
    return refuse(ExitCode::kExitFailure, error.what());
  }
}

int run(int argc, char** argv) {
  CLI::App app("Liana: control of cable-driven snake arms", "liana");
  app.require_subcommand(1);
  app.footer(kFooter);
  add_global(app);
  Action action;
  PoseOptions pose;
  IkOptions ik;
  ReachOptions reach;
  PlanOptions plan;
  VerifyOptions verify;
  liana::system::RunOptions run, check;
  ConsoleOptions console;
  CalibrateOptions calibrate;
  LatencyOptions latency;
  ClientOptions client;
  FaultsOptions faults;
  CommandsOptions commands;
  ViewOptions view;
  LogOptions log;
  MissionOptions mission;
  ReplayOptions replay;
  DriveOptions drive;
  ExportOptions exported;
  RobotCheckOptions robot_check;
  RobotNewOptions robot_new;
  bool doctor_json = false;
  std::string shell = "bash";
  add_kinematics(app, action, pose, ik);
  add_reach(app, action, reach);
  add_plan(app, action, plan);
  add_verify(app, action, verify);
  add_run(app, action, run);
  add_check(app, action, check);
  add_console(app, action, console);
  add_view(app, action, view);
  add_client(app, action, "status", "state of every running system", client, status_command);
  add_client(app, action, "estop", "emergency stop of every running system: stop, brakes, disable", client,
             estop_command);
  add_client(app, action, "clear",
             "clear an emergency stop and the latched faults of one running system; enables nothing", client,
             clear_command, true);
  add_calibrate(app, action, calibrate);
  add_latency(app, action, latency);
  add_faults(app, action, faults);
  add_commands(app, action, commands);
  add_log(app, action, log);
  add_mission(app, action, mission);
  add_drive(app, action, drive);
  add_robot(app, action, exported, robot_check, robot_new);
  add_tools(app, action, replay, doctor_json, shell);
  const std::vector<std::string> words(argv + 1, argv + argc);
  const Refusal refuse(prints_json(words));
  try {
    app.parse(arguments_of(app, words));
  } catch (const CLI::ExtrasError&) {
    return refuse(ExitCode::kExitBadInput, extra_word_text(app));
  } catch (const CLI::ArgumentMismatch& error) {
    return refuse(ExitCode::kExitBadInput, missing_value_text(app, error.what()));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    return refuse(ExitCode::kExitBadInput, std::string(error.what()) + "; see liana help");
  } catch (const std::runtime_error& error) {  // of our own checks
    return refuse(ExitCode::kExitBadInput, error.what());
  }
  return perform(action, refuse);
}

}  // namespace

int main(int argc, char** argv) {
  liana::system::end_on_interrupt();
  return liana::system::after_standard_output(run(argc, argv));
}
