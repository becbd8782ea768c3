#include "host/apps/cli/options/tasks.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace liana::cli {
namespace {

constexpr const char* kTry = "Try it";
constexpr const char* kRun = "Run a mission";
constexpr const char* kSteer = "Steer by hand";
constexpr const char* kWrong = "When something is wrong";
constexpr const char* kCompute = "Plan and compute";
constexpr const char* kOwn = "Bring your own arm";
constexpr const char* kLook = "Look at what happened";
constexpr const char* kScripts = "For machines and scripts";
constexpr const char* kBelow = "Commands";  // of robot, drive, device, log

constexpr CommandText kCommands[] = {
    {"liana", "", "Liana: control of cable-driven and serial arms", "liana console --simulate"},

    {"liana help", kTry, "list the commands, or the options of one: liana help COMMAND", "liana help run"},
    {"liana doctor", kTry, "check what this computer can and cannot do, and what to do about it", "liana doctor"},
    {"liana console", kTry, "show and move an arm in a browser: the running one or a simulated one",
     "liana console --simulate"},

    {"liana run", kRun, "run a mission and report, on a simulated arm unless a bus table names real buses",
     "liana run lab_tour"},
    {"liana campaign", kRun, "run a mission for many seeds and values, into one database; show, compare, plot it",
     "liana campaign crossings --out crossings.db"},
    {"liana check", kRun, "rehearse a mission without an arm: what comes near a limit, what is refused",
     "liana check lab_tour"},
    {"liana mission", kRun, "pause, resume, step, confirm or abort the mission that runs", "liana mission pause"},
    {"liana status", kRun, "show the state of every running system", "liana status"},
    {"liana ground", kRun, "connect a ground station to a running system, or define the packets for one",
     "liana ground --xtce"},

    {"liana teleop", kSteer, "move an arm from this terminal, with keys or a gamepad", "liana teleop --simulate"},
    {"liana device", kSteer, "list the input devices of a running system, and watch their samples",
     "liana device list"},
    {"liana link", kSteer, "put a delay between input devices or a ground station and a running system",
     "liana link --listen /tmp/far.devices --devices /tmp/api.devices --delay 0.5,0.5"},

    {"liana estop", kWrong, "emergency stop of every running system: stop, brakes, disable", "liana estop"},
    {"liana clear", kWrong, "clear an emergency stop and latched faults of one running system; enables nothing",
     "liana clear"},
    {"liana recover", kWrong, "lead an arm that has lost a cable back along its path, on the cables that are left",
     "liana recover"},
    {"liana faults", kWrong, "list every fault: its number, what detects it, what it stops, what to do",
     "liana faults --refusals"},

    {"liana plan", kCompute, "plan a path past the scene to joint angles or a tip pose",
     "liana plan --robot three_segment_lab --scene lab_box --from-deg=5,-4,3,6,-4,2 --to-deg=-6,3,5,-5,8,4 "
     "--out plan.json"},
    {"liana verify", kCompute, "check a straight joint motion: would it be issued, what does it leave of the limits",
     "liana verify --robot micro --from-deg=prepare --to-deg=install --duration=60"},
    {"liana pose", kCompute, "compute tip pose, segment ends, Jacobian and cable lengths from joint angles",
     "liana pose --theta-deg=-8.5,0,-12,0,8,-2,13,0,12,-2"},
    {"liana ik", kCompute, "compute joint angles for a tip pose",
     "liana ik --from-deg=0,0,0,0,0,0,0,0,0,0 --tip=3.9,0.2,0,1,0,0,0"},
    {"liana reach", kCompute, "compute where the tip or a node can go, or how well a path is conditioned",
     "liana reach --samples=20000 --svg region.svg"},
    {"liana sweep", kCompute, "compute the self-motion of a 7-joint arm with its tip still, and its stiffness",
     "liana sweep --robot macro"},
    {"liana budget", kCompute, "compute the position error of a chain of arms, by formula and by random draws",
     "liana budget --draws=10000"},

    {"liana robot", kOwn, "write, check and export robot tables", "liana robot check three_segment_lab"},
    {"liana drive", kOwn, "try one motor on a desk, before there is a robot table (docs/reference/drives.md)",
     "liana drive scan --can can0"},
    {"liana calibrate", kOwn, "measure zeros, drums, directions and wiring of all drives, with the arm in jigs",
     "liana calibrate --out calibration.json"},

    {"liana view", kLook, "write the page of a run: what happened, in one file for a browser",
     "liana run lab_tour && liana view"},
    {"liana log", kLook, "list, show, export and verify the archives of runs (docs/reference/archive.md)",
     "liana log list"},
    {"liana commands", kLook, "list the commands of a run: verdicts, margins, refusals",
     "liana run lab_tour && liana commands --margins"},
    {"liana replay", kLook, "run a recording through the controller again and compare every output",
     "liana run lab_tour --record lab_run && liana replay lab_run"},

    {"liana completion", kScripts, "print tab completion for bash or zsh", "liana completion bash"},
    {"liana latency", kScripts, "measure wake-up delay and tick duration of the real-time thread on this computer",
     "liana latency --seconds 5"},
    {"liana force", kScripts, "measure how well contact forces are estimated, on a simulated arm",
     "liana force --self-test"},

    {"liana campaign show", kBelow, "shares of outcomes with intervals, quantiles of figures, the ten worst rows",
     "liana campaign show crossings.db"},
    {"liana campaign compare", kBelow, "two campaigns beside each other", "liana campaign compare before.db after.db"},
    {"liana campaign plot", kBelow, "write a picture of one campaign, or of two",
     "liana campaign plot crossings.db --svg crossings.svg"},
    {"liana device list", kBelow, "list what is connected: kind, rate, delays, force", "liana device list"},
    {"liana device watch", kBelow, "print the newest sample of a device, again and again",
     "liana device watch operator-handles --seconds 5"},
    {"liana drive scan", kBelow, "list which nodes answer, and what they are", "liana drive scan --can can0"},
    {"liana drive read", kBelow, "read an object of a drive", "liana drive read 6064 --can can0 --node 5"},
    {"liana drive write", kBelow, "write an object of a drive, and read it back",
     "liana drive write 6065 2000 --can can0 --node 5"},
    {"liana drive watch", kBelow, "read an object of a drive, again and again",
     "liana drive watch 6064 --can can0 --node 5 --seconds 5"},
    {"liana drive type", kBelow, "make a drive type from the maker's electronic data sheet (EDS)",
     "liana drive type --from-eds drive.eds --out drives/my_drive.lua"},
    {"liana drive check", kBelow, "say whether a drive would boot, and all that a boot would refuse; reads only",
     "liana drive check --can can0 --node 5"},
    {"liana drive jog", kBelow, "turn a motor a short way: enable, move, stop, disable",
     "liana drive jog --can can0 --node 5 --by 0.1"},
    {"liana log list", kBelow, "list the newest runs: begin, outcome, length, size", "liana log list"},
    {"liana log show", kBelow, "show the events, refusals, faults and steps of a run",
     "liana run lab_tour && liana log show"},
    {"liana log verify", kBelow, "check whether the archive of a run is whole, and what it holds",
     "liana run lab_tour && liana log verify"},
    {"liana log export", kBelow, "write a run for other tools: CSV, MCAP (Foxglove, ROS 2), candump, ticks",
     "liana run lab_tour && liana log export --csv lab_run.csv"},
    {"liana ground store", kBelow, "keep telemetry on the ground, and ask again for what is missing",
     "liana ground store telemetry.db"},
    {"liana ground show", kBelow, "print the packets of such a file, decoded",
     "liana ground show telemetry.db --name arm"},
    {"liana robot new", kBelow, "write a commented robot table from a few answers",
     "liana robot new my_arm --segments 3 --modules 4"},
    {"liana robot check", kBelow, "check whether a robot fits: capacity, bus load, workspace, tensions, holes, jigs",
     "liana robot check three_segment_lab"},
    {"liana robot export", kBelow,
     "write a robot table as canonical JSON, or as a model for ROS (URDF) or MuJoCo (MJCF)",
     "liana robot export zhu2022 --mjcf --scene panel_slit --out zhu2022.xml"},
};

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 failed, 2 bad input, 3 inverse kinematics did not converge or there is no plan,\n"
    "4 estop found nothing to stop, 130 interrupted; one message on standard error says what, with --json standard "
    "output has it, too.\n"
    "Angles are degrees where the option says deg, lengths metres, poses in the base frame.";
constexpr const char* kDriveFooter =
    "Exit codes: 0 done, 1 refused or failed, 2 bad input, a bus that is not there included, 3 nobody answers,\n"
    "130 interrupted; one message on standard error says what, with --json standard output has it, too.";

std::string path_of(const CLI::App& app) {
  return app.get_parent() == nullptr ? "liana" : path_of(*app.get_parent()) + " " + app.get_name();
}

const CommandText& text_of(std::string_view path) {
  const auto row = std::find_if(std::begin(kCommands), std::end(kCommands),
                                [path](const CommandText& each) { return each.path == path; });
  if (row == std::end(kCommands)) throw std::logic_error(std::string(path) + ": has no row in kCommands");
  return *row;
}

// Lists commands in the order of the table, under the headings of their groups.
class ByTask : public CLI::Formatter {
  std::string make_subcommands(const CLI::App* app, CLI::AppFormatMode) const override {
    const std::string above = path_of(*app) + " ";
    std::string text, group;
    for (const CommandText& row : kCommands) {
      const std::string_view path = row.path;
      if (!path.starts_with(above) || path.find(' ', above.size()) != path.npos) continue;
      if (group != row.group) text += "\n" + (group = row.group) + ":\n";
      text += make_subcommand(app->get_subcommand(std::string(path.substr(above.size()))));
    }
    return text;
  }
};

}  // namespace

std::span<const CommandText> command_texts() { return kCommands; }

void explain(CLI::App& app) {
  const std::string path = path_of(app);
  const CommandText& row = text_of(path);
  app.description(row.about);
  app.footer(std::string(path.starts_with("liana drive") ? kDriveFooter : kFooter) + "\n\nExample: " + row.example);
  app.formatter(std::make_shared<ByTask>());
  for (CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) explain(*below);
}

}  // namespace liana::cli
