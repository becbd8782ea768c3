// Options of the commands that carry out a mission: run, check, mission.
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"
#include "host/apps/cli/options/words.hpp"

namespace liana::cli {
namespace {

void add_mission_options(CLI::App& sub, launcher::RunOptions& run) {
  sub.add_option("mission", run.mission, "a name under lua/missions, a file, or a plan (JSON of liana plan --out)")
      ->required();
  sub.add_option(
      "--robot", run.robot,
      "robot table: a name under lua/robots or a file; where not given that of the plan or the mission, else zhu2022");
  sub.add_option(
      "--scene", run.scene,
      "scene table: a name under lua/scenes or a file; where not given that of the plan or the mission, else "
      "panel_slit, for a serial arm none");
  sub.add_option(
      "--bus", run.bus,
      "bus table: a name under lua/buses or a file; where not given that of the mission with its own robot, else "
      "embedded_ROBOT if there is such a table, else one for the robot's drives on simulated buses");
  sub.add_option("--start-pose", run.start_pose,
                 "where the simulated arm begins: a named pose of the robot, or all its angles, t1,t2,... deg; where "
                 "not given the table's start_pose, else prepare or zero");
  add_physics(sub, run.physics);
  sub.add_option("--calibration", run.calibration,
                 "what liana calibrate wrote; the robot table's values where not given");
  sub.add_option("--faults", run.faults,
                 "to try it out: faults of the simulated drives, cables and camera (docs/how-to/run-hil.md)")
      ->check(CLI::ExistingFile);
  sub.add_option("--fault", run.fault,
                 "to try it out: a fault that the mission is shipped with, by its name (MISSION/faults/NAME.json "
                 "beside it)")
      ->excludes("--faults");
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

// Who steers, and over what.
void add_people(CLI::App& sub, launcher::OperatorChoice& people) {
  sub.add_option("--operator", people.who,
                 "recorded: VR handles from a file, a simulated person at the hand controller; model: an operator "
                 "model at simulated devices in every step (docs/explanation/operator-model.md); recorded where "
                 "nothing is said")
      ->check(CLI::IsMember({"recorded", "model"}));
  sub.add_option("--delay", people.delay,
                 "of the model: FORWARD_S,RETURN_S, e.g. 0.5,0.5; delays of the link between hand and arm, 0 to 2 s");
  sub.add_option("--feedback", people.feedback,
                 "of the model: the law of the force on the hand, or off; as the mission's steps say where not given")
      ->check(CLI::IsMember({"aligned", "claim", "abstract", "off"}));
  sub.add_option("--fixtures", people.fixtures,
                 "off: no fixture of the scene guides the hand or is felt, whatever the mission says "
                 "(docs/explanation/virtual-fixtures.md)")
      ->check(CLI::IsMember({"on", "off"}));
  sub.add_option(
         "--temper", people.temper,
         "lively: whoever steers has bursts and reversals, drifts, trembles more, loses grips in motion and "
         "holds both devices, details by --seed (docs/explanation/operator-model.md); gentle where nothing is said")
      ->check(CLI::IsMember({"gentle", "lively"}));
  sub.add_option("--passivity", people.passivity,
                 "of the model: energy tank and damping at the hand controller; on where nothing is said")
      ->check(CLI::IsMember({"on", "off"}));
}

void add_run(CLI::App& app, Action& action) {
  auto [sub, run] = add<launcher::RunOptions>(app, action, "run", run_command);
  add_mission_options(sub, run);
  sub.add_option("--time", run.time, "fast, paced or real; fast where nothing is said, real on SocketCAN")
      ->check(CLI::IsMember({"fast", "paced", "real"}));
  sub.add_option("--in-pose", run.in_pose,
                 "named pose in which the arm lies in its jig: unless every cable says so, it is not enabled");
  add_cross_wired(sub, run.cross_wired);
  add_people(sub, run.people);
  sub.add_option("--record", run.record_dir, "keep recording, logs, bus traffic and report in this directory");
  sub.add_flag("--lean", run.is_lean, "keep nothing of a success but its report: no archive, no bus traffic")
      ->excludes("--record");
  sub.add_flag("--console", run.has_console, "show it in a browser while it runs; the address goes to standard error");
}

void add_check(CLI::App& app, Action& action) {
  auto [sub, check] = add<launcher::RunOptions>(app, action, "check", check_command);
  add_mission_options(sub, check);
}

void add_mission(CLI::App& app, Action& action) {
  auto [sub, mission] = add<MissionOptions>(app, action, "mission", mission_command);
  sub.add_option("command", mission.command,
                 "pause: the arm holds; resume: go on; step: one step, then a pause; confirm: what the step asks for; "
                 "abort: end it")
      ->required()
      ->check(CLI::IsMember({"pause", "resume", "step", "confirm", "abort"}));
  sub.add_option("--api", mission.api,
                 "API socket of the lianad; where not given, that of the one running system of this user");
  add_json(sub, mission.json);
}

// A command below `campaign` that reads `count` databases, of plot up to so many.
Declared<CampaignShowOptions> add_campaign_reader(CLI::App& group, Action& action, const char* name, int count,
                                                  int (*command)(const CampaignShowOptions&)) {
  auto [sub, show] = add<CampaignShowOptions>(group, action, name, command);
  sub.add_option("database", show.databases, count > 1 ? "databases of campaigns" : "database of a campaign")
      ->required()
      ->expected(command == campaign_plot_command ? 1 : count, count);
  sub.add_option("--figure", show.figures,
                 "number of the report, e.g. tip_error_m or verified_clearance_m.min; may be repeated; the main ones "
                 "where not given")
      ->take_all()
      ->allow_extra_args(false);
  add_json(sub, show.json);
  return {sub, show};
}

void add_campaign_readers(CLI::App& group, Action& action) {
  auto [sub, show] = add_campaign_reader(group, action, "show", 1, campaign_show_command);
  sub.add_option("--by", show.by,
                 "figure of the worst rows; small values of a clearance or a minimum are bad, large ones of others; "
                 "min_clearance_m where not given");
  add_campaign_reader(group, action, "compare", 2, campaign_compare_command);
  auto [plot, drawn] = add_campaign_reader(group, action, "plot", 2, campaign_plot_command);
  plot.add_option("--svg", drawn.svg_file, "write the picture to this file; NAME.svg where not given");
}

void add_campaign(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CampaignOptions>();
  options->check_words = check_words_of_run;
  CLI::App& sub = *app.add_subcommand("campaign");
  sub.callback([&sub, &action, options] {
    if (sub.get_subcommands().empty()) action = [options] { return campaign_command(*options); };
  });
  sub.add_option("file", options->file, "campaign: a name under lua/campaigns or a file");
  sub.add_option("--engine", options->engine, "local: this computer; slurm: a cluster")
      ->capture_default_str()
      ->check(CLI::IsMember({"local", "slurm"}));
  sub.add_option("--out", options->out,
                 "the database, SQLite; where not given NAME.db in this folder; rows that are there are not run again");
  sub.add_option("--jobs", options->jobs, "rows at a time on this computer; one a processor where not given");
  sub.add_option("--rows", options->rows, "only these rows, e.g. 3,7-9; with --full or --results");
  sub.add_option("--full", options->full, "run --rows and keep everything of each in this folder; no database");
  sub.add_option("--results", options->results,
                 "run --rows and write each result to this folder, as JSON; no database");
  add_json(sub, options->json);
  add_campaign_readers(sub, action);
}

// The ground's side of the link.
void add_ground_store(CLI::App& ground, Action& action) {
  auto [store, kept] = add<GroundStoreOptions>(ground, action, "store", ground_store_command);
  store.add_option("file", kept.file, "SQLite file; what is there stays")->required();
  store.add_option("--telemetry", kept.telemetry, "ADDR:PORT of liana ground, or of a line to it")
      ->capture_default_str();
  store.add_option("--telecommand", kept.telecommand, "ADDR:PORT that takes questions for packets, by UDP")
      ->capture_default_str();
  store.add_option("--keep-h", kept.keep_h, "hours of telemetry that stay in the file; 0.01 to 8760")
      ->capture_default_str()
      ->check(within(0.01, 8760.0));
  add_json(store, kept.json);
  auto [show, shown] = add<GroundStoreOptions>(ground, action, "show", ground_show_command);
  show.add_option("file", shown.file, "what liana ground store wrote")->required();
  show.add_option("--name", shown.name, "only reports of this name (docs/reference/ground-packets.md)");
  show.add_option("--robot", shown.robot, "whose telemetry it is: a name under lua/robots or a file")
      ->capture_default_str();
  show.add_flag("--json", shown.json, "the output is JSON with or without it");
}

void add_ground(CLI::App& app, Action& action) {
  const auto options = std::make_shared<GroundOptions>();
  GroundOptions& ground = *options;
  CLI::App& sub = *app.add_subcommand("ground");
  sub.callback([&sub, &action, options] {
    if (sub.get_subcommands().empty()) action = [options] { return ground_command(*options); };
  });
  CLI::Option* xtce = sub.add_flag("--xtce", ground.xtce, "print the packets as XTCE 1.2, for Yamcs and others");
  CLI::Option* cosmos = sub.add_flag("--cosmos", ground.cosmos, "print them as definitions of COSMOS");
  sub.add_flag("--markdown", ground.markdown, "print docs/reference/ground-packets.md")
      ->excludes(xtce)
      ->excludes(cosmos);
  xtce->excludes(cosmos);
  sub.add_option("--robot", ground.robot, "of these: a name under lua/robots or a file")->capture_default_str();
  sub.add_option("--api", ground.api,
                 "API socket of a lianad; where not given, that of the one running system of this user");
  sub.add_option("--telemetry", ground.telemetry, "ADDR:PORT where ground stations read telemetry, by TCP")
      ->capture_default_str();
  sub.add_option("--telecommand", ground.telecommand, "ADDR:PORT that takes telecommands, by TCP and UDP")
      ->capture_default_str();
  sub.add_option("--udp-to", ground.udp_to, "ADDR:PORT to which telemetry goes by UDP, too");
  sub.add_option("--silence-s", ground.silence_s, "without a telecommand for so long the link is lost; 1 to 3600")
      ->capture_default_str()
      ->check(within(1.0, 3600.0));
  sub.add_option("--store-mb", ground.store_mb, "of telemetry kept to be sent again; 1 to 4096")
      ->capture_default_str()
      ->check(within(1.0, 4096.0));
  sub.add_flag("--trusted-network", ground.trusted_network,
               "listen beyond this computer: whoever reaches the ports can move the arm");
  add_json(sub, ground.json);
  add_ground_store(sub, action);
}

}  // namespace

void declare_missions(CLI::App& app, Action& action) {
  add_run(app, action);
  add_campaign(app, action);
  add_check(app, action);
  add_mission(app, action);
  add_ground(app, action);
}

}  // namespace liana::cli
