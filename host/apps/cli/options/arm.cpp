// Options of the commands for an arm as it stands there: status, estop, clear, calibrate, latency, faults.
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"

namespace liana::cli {
namespace {

void add_client_options(CLI::App& sub, ClientOptions& client) {
  sub.add_option("--api", client.api, "API socket of one lianad; where not given, all running systems of this user");
  sub.add_flag("--json", client.json, "print JSON, one line for each system");
}

void add_status(CLI::App& app, Action& action) {
  auto [sub, status] = add<StatusOptions>(app, action, "status", status_command);
  add_client_options(sub, status.client);
  sub.add_option("--udp", status.udp,
                 "HOST:PORT: send every state there as JSON, for PlotJuggler and others, until Ctrl-C");
}

void add_estop(CLI::App& app, Action& action) {
  auto [sub, client] = add<ClientOptions>(app, action, "estop", estop_command);
  add_client_options(sub, client);
}

void add_clear(CLI::App& app, Action& action) {
  auto [sub, client] = add<ClearOptions>(app, action, "clear", clear_command);
  sub.add_option("--api", client.api,
                 "API socket of the lianad; where not given, that of the one running system of this user (several are "
                 "refused)");
  sub.add_flag("--json", client.json, "print JSON, also when nothing could be cleared");
  sub.add_option("--whole", client.whole, "this cable of fault 5006 is whole: somebody has looked at it")
      ->check(CLI::Range(1, 64));
}

void add_recover(CLI::App& app, Action& action) {
  auto [sub, client] = add<ClientOptions>(app, action, "recover", recover_command);
  sub.add_option("--api", client.api,
                 "API socket of the lianad; where not given, that of the one running system of this user (several are "
                 "refused)");
  sub.add_flag("--json", client.json, "print JSON at the end, also when the arm stays where it is");
}

void add_calibrate(CLI::App& app, Action& action) {
  auto [sub, calibrate] = add<CalibrateOptions>(app, action, "calibrate", calibrate_command);
  add_robot(sub, calibrate.robot);
  sub.add_option("--bus", calibrate.bus, "bus table; where not given as for liana run");
  sub.add_option("--poses", calibrate.poses,
                 "named poses of the robot for which there are jigs, two or more; where not given the table's "
                 "jig_poses, else zero,jig,prepare; with --load: where it is measured, without jigs");
  add_physics(sub, calibrate.physics);
  add_cross_wired(sub, calibrate.cross_wired);
  sub.add_option("--out", calibrate.out_file,
                 "write the calibration to this file, for lianad --calibration and liana run --calibration");
  sub.add_flag(
      "--friction", calibrate.friction,
      "measure the cables' friction instead: the arm is enabled and each segment turned by 3 deg to and fro, for "
      "about three minutes; needs 0.5 m of room around it");
  sub.add_flag(
         "--load", calibrate.load,
         "measure weight and springs instead: the arm is enabled and goes to twelve poses, or to those of --poses, "
         "each from two sides, for about five minutes; needs room for all its poses")
      ->excludes("--friction");
  CLI::Option* known = sub.add_option("--calibration", calibrate.calibration,
                                      "with --friction, --load or --tracker: the calibration that it is added to; with "
                                      "--tracker that of the run");
  sub.add_option("--tracker", calibrate.tracker,
                 "find lengths, hole radius and stiffness instead, from the poses of a marker at the tip during a run, "
                 "a CSV file; no arm moves")
      ->needs(known)
      ->excludes("--friction", "--load", "--poses", "--cross-wired");
  sub.add_option("--run", calibrate.run,
                 "with --tracker: the run, a folder or a name of liana log list; the newest "
                 "where not given")
      ->needs("--tracker");
  add_seed(sub, calibrate.seed, "of the simulated arm");
  add_json(sub, calibrate.json);
}

void add_latency(CLI::App& app, Action& action) {
  auto [sub, latency] = add<LatencyOptions>(app, action, "latency", latency_command);
  sub.add_option("--robot", latency.robot, "robot table: a name under lua/robots or a file; zhu2022 where not given");
  sub.add_option("--rate", latency.rate_hz, "250 or 500 Hz")->default_str("250");
  sub.add_option_function<std::string>(
         "--seconds",
         [&seconds = latency.seconds](const std::string& text) {
           seconds = parse_number_in("--seconds", text, 0.1, 86400.0, "s");
         },
         "how long to measure; 0.1 to 86400")
      ->default_str("10");
  sub.add_option(
      "--buses", latency.buses,
      "bus table, in place of the embedded one of the rate or the robot: vcan, or a table of your interfaces");
  sub.add_option("--arm", latency.arm,
                 "the bench's arm model: full, or light (no inertia, contact or cable friction) for slow machines")
      ->capture_default_str()
      ->check(CLI::IsMember({"full", "light"}));
  add_json(sub, latency.json);
}

void add_faults(CLI::App& app, Action& action) {
  auto [sub, faults] = add<FaultsOptions>(app, action, "faults", faults_command);
  sub.add_option("--robot", faults.robot, "robot table whose tick counts")->capture_default_str();
  sub.add_flag("--refusals", faults.refusals, "refusal codes of verification in place of faults");
  sub.add_flag("--markdown", faults.markdown,
               "print the table of docs/reference/faults.md, or of docs/reference/refusals.md");
  add_json(sub, faults.json);
}

void add_force(CLI::App& app, Action& action) {
  auto [sub, force] = add<ForceOptions>(app, action, "force", force_command);
  sub.add_flag("--self-test", force.self_test, "push a simulated arm and compare what it tells with the truth");
  sub.add_option("--robot", force.robot, "a cable arm's table")->capture_default_str();
  add_physics(sub, force.physics);
  sub.add_option("--configurations", force.configurations, "places about which the arm is pushed, 1 to 1000")
      ->capture_default_str();
  sub.add_option("--pushes", force.pushes, "in each, 1 to 100: at rest, dithered and on the move")
      ->capture_default_str();
  add_seed(sub, force.seed, "of pushes, places and of the bench");
  add_json(sub, force.json);
}

}  // namespace

void declare_arm(CLI::App& app, Action& action) {
  add_status(app, action);
  add_estop(app, action);
  add_clear(app, action);
  add_recover(app, action);
  add_calibrate(app, action);
  add_latency(app, action);
  add_force(app, action);
  add_faults(app, action);
}

}  // namespace liana::cli
