// Options of the commands that show what is and what was: console, teleop, view, commands, log, replay.
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"

namespace liana::cli {
namespace {

void add_gateway_options(CLI::App& sub, launcher::GatewayOptions& gateway) {
  sub.add_option(
      "--listen", gateway.listen,
      "ADDR:PORT; where not given 127.0.0.1:8765, or a free port where that is taken; beyond this machine it "
      "takes --token-file, --cert and --key");
  sub.add_option(
      "--token-file", gateway.token_file,
      "lines NAME ROLE TOKEN, roles watch, operate, administer; mode 0600 (docs/reference/console-protocol.md)");
  sub.add_option("--cert", gateway.certificate, "certificate for TLS, PEM");
  sub.add_option("--key", gateway.key, "its key, PEM");
}

void add_system(CLI::App& sub, SystemSelection& wish) {
  sub.add_option(
      "--api", wish.api,
      "API socket of a lianad; where not given, that of the one running system of this user, or a simulated arm");
  sub.add_flag("--simulate", wish.simulate, "start a simulated arm, also where a system runs");
  sub.add_option("--robot", wish.run.robot,
                 "of the simulated arm: a name under lua/robots or a file; zhu2022 where not given");
  sub.add_option("--scene", wish.run.scene,
                 "of the simulated arm: a name under lua/scenes or a file; panel_slit where not given, for a serial "
                 "arm none");
  sub.add_option("--bus", wish.run.bus, "of the simulated arm: an embedded bus table");
  sub.add_option("--start-pose", wish.run.start_pose,
                 "of the simulated arm: a named pose of the robot, or all its angles, t1,t2,... deg");
  sub.add_option("--faults", wish.run.faults,
                 "to practise: faults of the simulated arm's drives, cables and camera (docs/how-to/run-hil.md)")
      ->check(CLI::ExistingFile);
  add_physics(sub, wish.run.physics, "of the simulated arm: ");
  sub.add_option("--calibration", wish.run.calibration, "of the simulated arm: what liana calibrate wrote");
  add_seed(sub, wish.run.seed, "of the simulated arm");
}

void add_console(CLI::App& app, Action& action) {
  auto [sub, console] = add<ConsoleOptions>(app, action, "console", console_command);
  add_system(sub, console.wish);
  add_gateway_options(sub, console.gateway);
  add_json(sub, console.json);
}

void add_teleop(CLI::App& app, Action& action) {
  auto [sub, teleop] = add<TeleopOptions>(app, action, "teleop", teleop_command);
  add_system(sub, teleop.wish);
  sub.add_option("--gamepad", teleop.gamepad,
                 "a joystick device like /dev/input/js0, beside the keys (docs/how-to/teleoperate.md)");
}

void add_link(CLI::App& app, Action& action) {
  auto [sub, link] = add<LinkOptions>(app, action, "link", link_command);
  sub.add_option("--listen", link.listen, "where the line begins: a socket for devices; with --to ADDR:PORT")
      ->required();
  CLI::Option* devices = sub.add_option("--devices", link.devices, "lianad's socket of devices, to which they go on");
  CLI::Option* to = sub.add_option("--to", link.to, "ADDR:PORT of liana ground: packets go on there, by TCP and UDP");
  to->excludes(devices);
  sub.add_option("--outage", link.outage, "AFTER_S,FOR_S: nothing comes through for so long; each 0 to 86400")
      ->needs(to);
  sub.add_option("--delay", link.delay, "FORWARD_S,RETURN_S, e.g. 0.5,0.5, each 0 to 2 s");
  sub.add_option("--jitter", link.jitter, "share by which every delay varies; packets overtake each other")
      ->check(within(0.0, 1.0));
  sub.add_option("--loss", link.loss, "share of samples and states, or of packets, that never come")
      ->check(within(0.0, 1.0));
  add_seed(sub, link.seed, "seed of jitter and loss");
  add_json(sub, link.json);
}

void add_view(CLI::App& app, Action& action) {
  auto [sub, view] = add<ViewOptions>(app, action, "view", view_command);
  CLI::Option* run = sub.add_option(
      "run", view.run, "a folder, or the name of one of the newest runs; where not given, the one that ended last");
  CLI::Option* out = sub.add_option("--out", view.out_file, "write the page here, not as page.html beside the run");
  sub.add_flag("--live", view.live, "the console of a running system instead")->excludes(run)->excludes(out);
  sub.add_option("--api", view.api, "with --live: API socket of a lianad")->needs("--live");
  add_json(sub, view.json);
}

void add_commands(CLI::App& app, Action& action) {
  auto [sub, commands] = add<CommandsOptions>(app, action, "commands", command_log);
  sub.add_option("run", commands.run,
                 "a folder, the name of one of the newest runs, or a commands.txt; where not given, the newest run");
  sub.add_option_function<std::string>(
         "--last",
         [&last = commands.last](const std::string& text) {
           last = static_cast<std::uint32_t>(parse_whole("--last", text, 1, 1000000000));
         },
         "so many of the newest; 1 to 1000000000")
      ->default_str("20");
  sub.add_flag("--refused", commands.refused, "only refused ones");
  sub.add_flag("--margins", commands.margins, "what they all left of the limits, in place of a list");
  sub.add_flag("--json", commands.json, "print JSON, one line for each command");
}

void add_arm_time(CLI::App& sub, const char* option, double& value_s) {
  sub.add_option_function<std::string>(
      option,
      [&value_s, option](const std::string& text) {
        value_s = parse_number_in(option, text, 0.0, kLatestArmTime_s, "s of arm time");
      },
      "arm time, s; 0 to 1e9");
}

// What a command of `log` is for one run.
Declared<LogOptions> add_log_of_run(CLI::App& log, Action& action, const char* name,
                                    int (*command)(const LogOptions&)) {
  auto [sub, options] = add<LogOptions>(log, action, name, command);
  sub.add_option("run", options.run, "a folder, or the name of one of the newest runs; the newest where not given");
  add_json(sub, options.json);
  return {sub, options};
}

void add_arm_times(CLI::App& sub, LogOptions& log) {
  add_arm_time(sub, "--from", log.from_s);
  add_arm_time(sub, "--to", log.to_s);
}

void add_log_export(CLI::App& log, Action& action) {
  auto [sub, exported] = add_log_of_run(log, action, "export", log_export_command);
  add_arm_times(sub, exported);
  sub.add_option("--csv", exported.csv, "file for telemetry as a table");
  sub.add_option("--mcap", exported.mcap, "file for the arm in its scene, angles, events, as Foxglove shows them");
  sub.add_option("--ros2", exported.ros2,
                 "file for joints, frames, poses, forces, diagnostics, as ros2 bag play takes it");
  sub.add_option("--candump", exported.candump, "file for the traffic of all buses");
  sub.add_option("--tracker", exported.tracker,
                 "of a simulated run with --record: file for what a tracker would have seen of its tip, for liana "
                 "calibrate --tracker");
  CLI::Option* ticks =
      sub.add_option("--ticks", exported.ticks, "folder for every control tick, as --record writes it: liana replay");
  sub.add_flag("--wall-time", exported.wall_time, "times are UTC (when the run began, plus arm time), not arm time")
      ->excludes(ticks);
}

void add_log(CLI::App& app, Action& action) {
  CLI::App& log = add_group(app, "log");
  auto [list, listed] = add<LogOptions>(log, action, "list", log_list_command);
  add_json(list, listed.json);
  auto [show, shown] = add_log_of_run(log, action, "show", log_show_command);
  add_arm_times(show, shown);
  add_log_of_run(log, action, "verify", log_verify_command);
  add_log_export(log, action);
}

void add_replay(CLI::App& app, Action& action) {
  auto [sub, replay] = add<ReplayOptions>(app, action, "replay", replay_command);
  sub.add_option("directory", replay.directory,
                 "what `liana run --record` wrote: a folder, or the name of one of the newest runs")
      ->required();
  add_json(sub, replay.json);
}

}  // namespace

void declare_seeing(CLI::App& app, Action& action) {
  add_console(app, action);
  add_teleop(app, action);
  add_link(app, action);
  add_view(app, action);
  add_commands(app, action);
  add_log(app, action);
  add_replay(app, action);
}

}  // namespace liana::cli
