// Every command of `liana`: its options as a struct, and the function that does it and returns the exit code.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/apps/cli/system_choice.hpp"
#include "host/apps/launcher/gateway_process.hpp"
#include "host/apps/launcher/run_options.hpp"

namespace liana::cli {

// Of a lianad that a command asks.
inline constexpr double kConnectTimeout_s = 1.0;
inline constexpr double kAnswerTimeout_s = 5.0;

struct PoseOptions {
  std::string robot = "zhu2022";
  std::string theta_deg;
  std::string scene;  // empty: without a slit
  bool json = false;
};
// Forward kinematics and cable lengths of one pose, and its planar part in a scene's slit.
int pose_command(const PoseOptions& options);

struct IkOptions {
  std::string robot = "zhu2022";
  std::string from_deg;
  std::string tip;
  std::string hold;                         // empty: nothing is held
  std::vector<std::string> control_points;  // in order
  bool json = false;
};
// The goal solver; exit code 3 when it did not converge.
int ik_command(const IkOptions& options);

struct ReachOptions {
  std::string robot = "zhu2022";
  std::string scene;     // empty: none is drawn
  std::string hold;      // empty: nothing is held; cable arms only, as to_deg and path
  std::string from_deg;  // region: where held thetas are and the arm is drawn, zero pose where empty; path: its begin
  std::string to_deg;    // path: its end
  std::string path;      // path: a file with waypoints_deg
  std::string node;      // empty: the tip
  std::string samples = "200000";
  std::uint64_t seed = 1;
  std::string svg_file;  // empty: no picture
  bool carry = false;    // what the cables pull there, for every mounting, in place of the region
  bool json = false;
};
// Where the tip or a node of either kind of arm can go, how well a cable arm is conditioned along a path, or what its
// cables pull where.
int reach_command(const ReachOptions& options);

struct BudgetOptions {
  std::string budget = "payload_install";  // a name under lua/budgets, or a file
  std::string draws = "100000";
  std::uint64_t seed = 1;
  std::string svg_file;  // empty: no picture
  bool json = false;
};
// How far beside its goal a chain of arms puts what it carries, by formula and by chance
// (docs/explanation/workspace.md).
int budget_command(const BudgetOptions& options);

struct SweepOptions {
  std::string robot = "macro";
  std::string from_deg;  // angles or the name of a pose; empty: the robot's start pose
  std::string svg_file;  // empty: no picture
  bool json = false;
};
// All configurations of a 7-joint arm with the tip still, and how far each gives way; exit code 1 when they form no
// closed motion (docs/explanation/workspace.md).
int sweep_command(const SweepOptions& options);

struct VerifyOptions {
  std::string robot = "zhu2022";
  std::string scene;     // empty: panel_slit, for a serial arm none
  std::string from_deg;  // angles or the name of a pose, as to_deg
  std::string to_deg;
  std::string duration_s;
  bool carrying = false;  // the scene's payload
  bool json = false;
};
// The simulation end's verdict on a straight motion in joint space; exit code 0 whether it is accepted or refused.
int verify_command(const VerifyOptions& options);

struct PlanOptions {
  std::string robot = "zhu2022";
  std::string scene = "panel_slit";  // "none": nothing in the way
  std::string from_deg;
  std::string to_deg;                       // either this
  std::string tip;                          // or this
  std::string follow;                       // empty: no curve; a curve's file, or "slit"
  std::string hold;                         // empty: nothing is held
  std::string planar;                       // empty: no planar phases
  std::vector<std::string> control_points;  // in order
  std::string waypoints;                    // empty: 20, or as many as following needs
  std::string margin_m = "0.005";
  std::string max_step_deg;    // empty: the planner's default
  std::string max_iterations;  // empty: the planner's default
  std::string out_file;        // empty: the plan is only printed
  bool json = false;
};
// The offline planner; exit code 3 when there is no plan, 130 when it was interrupted.
int plan_command(const PlanOptions& options);

// Starts the whole system, runs one mission, reports; exit code 0 only on success.
int run_command(const launcher::RunOptions& options);

// The same without anything that moves and without a trace: virtual time on the embedded bus, found by nobody else's
// status, estop or clear. Says what the steps leave of the limits and what is refused; exit code 0 only on success.
int check_command(const launcher::RunOptions& given);

struct CampaignOptions {
  std::string file;              // a name under lua/campaigns, or a file
  std::string engine = "local";  // or slurm
  std::string out;               // the database; empty: NAME.db here
  std::string jobs;              // rows at a time; empty: one a processor
  std::string rows;              // only these, with one of the next two: 3,7-9
  std::string full;              // a folder where each of them keeps everything
  std::string results;           // a folder that takes each result as a JSON file
  bool json = false;
  // Throws BadInput where `liana run` does not take these words.
  std::function<void(const std::vector<std::string>&)> check_words;
};
// Runs a mission for many seeds and values, and goes on where it was killed (docs/how-to/run-a-campaign.md). Exit code
// 0 when every row has a result, whatever it is, and none was refused.
int campaign_command(const CampaignOptions& given);

struct CampaignShowOptions {
  std::vector<std::string> databases;  // show: one; compare: two; plot: one or two
  std::vector<std::string> figures;    // empty: the main ones
  std::string by;                      // show: the figure of the worst rows; empty: min_clearance_m
  std::string svg_file;                // plot; empty: NAME.svg here
  bool json = false;
};
// What a campaign's database says: shares of outcomes with intervals, quantiles of figures, the worst rows.
int campaign_show_command(const CampaignShowOptions& options);
// The same of two beside each other, and the rows whose outcome differs.
int campaign_compare_command(const CampaignShowOptions& options);
// The same as a picture, of one or two.
int campaign_plot_command(const CampaignShowOptions& options);

struct ConsoleOptions {
  SystemSelection wish;
  launcher::GatewayOptions gateway;  // where it listens, who may
  bool json = false;
};
// The console of a running system, or of a simulated arm without a mission; tells the address, ends with Ctrl-C.
int console_command(const ConsoleOptions& options);

struct TeleopOptions {
  SystemSelection wish;
  std::string gamepad;  // its device; empty: keys alone
};
// Drives the arm from this terminal, of a running system or a simulated one, until x or Ctrl-C
// (docs/how-to/teleoperate.md).
int teleop_command(const TeleopOptions& options);

struct LinkOptions {
  std::string listen, devices, to;  // either devices: sockets, or to: ADDR:PORT, as listen then is
  std::string delay = "0,0";        // FORWARD_S,RETURN_S
  std::string outage = "0,0";       // with to: AFTER_S,FOR_S
  double jitter = 0.05;             // share of a delay, 0 .. 1
  double loss = 0.0;                // share of samples and states, or of packets, 0 .. 1
  std::uint64_t seed = 1;
  bool json = false;
};
// Carries the packets of devices to lianad and back, late, until Ctrl-C (docs/explanation/operator-model.md); or those
// of a ground station to liana ground.
int link_command(const LinkOptions& options);

struct GroundOptions {
  std::string robot = "zhu2022";  // of the definitions
  bool xtce = false, cosmos = false, markdown = false;
  std::string api;  // empty: the one running system
  std::string telemetry = "127.0.0.1:10015", telecommand = "127.0.0.1:10025";
  std::string udp_to;  // HOST:PORT; empty: telemetry by TCP alone
  double silence_s = 10.0, store_mb = 64.0;
  bool trusted_network = false;
  bool json = false;
};
// The on-board end of a link to a ground station, until Ctrl-C; or the dictionary of its packets
// (docs/reference/ground-packets.md).
int ground_command(const GroundOptions& options);

struct GroundStoreOptions {
  std::string file;
  std::string telemetry = "127.0.0.1:10015", telecommand = "127.0.0.1:10025";
  double keep_h = 24.0;
  std::string robot = "zhu2022";  // show: whose packets they are
  std::string name;               // show: only reports of this name; empty: all
  bool json = false;
};
// Keeps telemetry on the ground and asks again for what is missing, until Ctrl-C; exit code 1 when packets are lost.
int ground_store_command(const GroundStoreOptions& options);
// The packets of such a file, a line each.
int ground_show_command(const GroundStoreOptions& options);

struct ViewOptions {
  std::string run;       // its folder, or its name among the newest; empty: the one that ended last
  bool live = false;     // the console of what runs, in place of a run's page
  std::string api;       // with live: as for the console
  std::string out_file;  // empty: page.html in the run's folder
  bool json = false;
};
// Writes the page of a run and prints its path.
int view_command(const ViewOptions& options);

struct CalibrateOptions {
  std::string robot = "zhu2022";
  std::string bus;    // empty: as for a run
  std::string poses;  // named poses of the fixtures; empty: those of the table, else zero, jig and prepare. With load:
                      // where it is measured; empty: chosen
  std::string physics = "nominal";
  std::string cross_wired;  // empty, or two drives of the simulated arm whose cables are exchanged
  std::string out_file;     // empty: the calibration is only printed
  std::string calibration;  // with friction, load or tracker: the file that it is added to
  std::string tracker;      // not empty: poses that a tracker saw, in place of a measurement
  std::string run;          // with tracker: during which run; empty: the newest
  std::uint64_t seed = 1;
  bool friction = false;  // move the arm and measure friction, instead of the drives in fixtures
  bool load = false;      // the same with weight and springs
  bool json = false;
};
// Reads the drives with the arm in fixtures, writes a calibration; exit code 1 when something is wired or wound wrong,
// which it names.
int calibrate_command(const CalibrateOptions& options);

struct LatencyOptions {
  std::string rate_hz;  // empty: that of the bus table, 250 where none is given
  double seconds = 10.0;
  std::string robot;         // empty: zhu2022
  std::string buses;         // empty: the embedded table of the rate, or of the robot
  std::string arm = "full";  // or light, for slow machines
  bool json = false;
};
// Measures lianad's real-time thread with the arm enabled and at rest; exit code 1 when a deadline was missed or the
// arm did not stay enabled.
int latency_command(const LatencyOptions& options);

struct ClientOptions {
  std::string api;  // empty: all running systems of this user
  bool json = false;
};
struct StatusOptions {
  ClientOptions client;
  std::string udp;  // HOST:PORT; empty: the state is printed once
};
// The state of every running system, each named by its socket; exit code 1 when one does not answer. With `udp` the
// states of the one running system as JSON datagrams, until Ctrl-C or the end of lianad.
int status_command(const StatusOptions& options);

struct DeviceOptions {
  std::string api;   // empty: every running system
  std::string name;  // watch: of the device
  std::string rate_hz = "10", seconds = "86400";
  bool json = false;
};
// What input devices are connected, what they can, and how their packets travel.
int device_list_command(const DeviceOptions& options);
// One device's newest samples, until it is over or interrupted; 1 when it is not connected.
int device_watch_command(const DeviceOptions& options);
// Emergency stop of every running system (stop, brakes, disable), each named by its socket; exit code 1 when one does
// not confirm.
int estop_command(const ClientOptions& options);

// Clears the emergency stop in force and the latched faults of one running system, and names them; it enables nothing.
// Exit code 1 when somebody else keeps motion, the arm is not at rest yet, or a fault is still there.
struct ClearOptions : ClientOptions {
  int whole = 0;  // cable of fault 5006 that somebody has looked at; 0: none
};
int clear_command(const ClearOptions& options);
// Leads an arm that has lost a cable back along its path without it, then disables it; says each step. Exit code 1 when
// the arm stays where it is, with the reason.
int recover_command(const ClientOptions& options);

struct ForceOptions {
  bool self_test = false;
  std::string robot = "zhu2022";
  std::string physics = "nominal";
  std::string configurations = "2";
  std::string pushes = "3";  // in each
  std::uint64_t seed = 1;
  bool json = false;
};
// How well the force at the tip is estimated: pushes of the bench beside what the arm tells
// (docs/explanation/contact-force.md).
int force_command(const ForceOptions& options);

struct FaultsOptions {
  std::string robot = "zhu2022";
  bool markdown = false;  // the table of docs/reference/faults.md, or of docs/reference/refusals.md
  bool refusals = false;  // error codes M_e of verification in place of faults
  bool json = false;
};
// Every fault number: how it is detected, what it stops, what to do.
int faults_command(const FaultsOptions& options);

struct MissionOptions {
  std::string command;  // pause, resume, step, confirm or abort
  std::string api;      // empty: the one running system
  bool json = false;
};
// Tells the mission of a running system how to go on; what comes of it depends on the step (lua/README.md).
int mission_command(const MissionOptions& options);

struct CommandsOptions {
  std::string run;          // its folder, its name among the newest, or its file of commands; empty: the newest
  std::uint32_t last = 20;  // so many of the newest
  bool refused = false;     // only those
  bool margins = false;     // what all of them left of the limits, in place of a list
  bool json = false;
};
// What became of the commands of a run: both verdicts, release, start, completion, refusals.
int command_log(const CommandsOptions& options);

constexpr double kLatestArmTime_s = 1e9;

struct LogOptions {
  std::string run;      // a folder, or the name of one of the newest runs; empty: the newest
  double from_s = 0.0;  // arm time
  double to_s = kLatestArmTime_s;
  std::string csv, mcap, ros2, candump, tracker;  // of log export: files
  std::string ticks;                              // of log export: a folder
  bool wall_time = false;                         // of log export: UTC in place of arm time
  bool json = false;
};
// The newest runs: name, begin, how each ended, length and size.
int log_list_command(const LogOptions& options);
// Events of a run and what is missing in its archive, in the order in which they happened.
int log_show_command(const LogOptions& options);
// The archive of a run in formats of other tools.
int log_export_command(const LogOptions& options);
// Whether the archive of a run is as it was written; exit code 1 when it is not.
int log_verify_command(const LogOptions& options);

struct ReplayOptions {
  std::string directory;
  bool json = false;
};
// Runs recorded Inputs through the core again; exit code 0 only when the recording is whole and no tick differs.
int replay_command(const ReplayOptions& options);

struct ExportOptions {
  std::string robot = "zhu2022";
  std::string scene;  // with urdf or mjcf; empty: the arm alone
  std::string file;   // empty: standard output
  bool urdf = false, mjcf = false;
};
// A robot table as canonical JSON, or as a model for other tools (docs/how-to/use-other-tools.md).
int export_command(const ExportOptions& options);

// How far a motor on a desk is turned.
struct JogOptions {
  std::string by;                  // the way, signed, in `unit`
  std::string speed;               // in `unit` a second; empty: 0.05 turns/s
  std::string unit = "turns";      // of the motor; or deg, mm
  std::string mm_per_turn;         // for mm
  std::string counts_per_turn;     // empty: the drive's 608F
  std::string most = "0.25";       // turns
  std::string max_speed = "0.25";  // turns/s
  std::string torque = "300";      // permille of rated
  bool yes = false;                // without a typed word
  bool clear = false;              // a fault from before
};

struct DriveOptions {
  std::string can;                  // a SocketCAN interface; else
  std::string bus;                  // a bus table
  std::string bitrate = "1000000";  // of `can`
  std::string bus_socket;           // of liana-bus, where the table's backend is embedded
  std::string time = "real";        // of liana-bus
  std::string node;                 // nobody is taken for named
  std::string axis = "1";           // of it
  std::string object;               // "6064", "1018:1"
  std::string value, bits = "32";
  std::string first = "1", last = "126";  // node ids
  std::string rate_hz = "5", seconds = "10";
  std::string type = "cia402_csp";
  std::string robot;   // check: all drives of it; empty: the node
  bool tries = false;  // check: writes, too, and puts back
  JogOptions jog;
  std::string eds, mode = "csp", out = "-";  // type
  bool json = false;
};
// One motor on a desk. All end with 3 when nobody answers, and with 1 when the drive refuses.
// Which nodes there are, and what they say of themselves.
int drive_scan_command(const DriveOptions& options);
// The value of an object; that it is given, and read back; that it has again and again.
int drive_read_command(const DriveOptions& options);
int drive_write_command(const DriveOptions& options);
int drive_watch_command(const DriveOptions& options);
// Resets communication and goes through the boot of a drive type, or of all drives of a robot: whether it would boot,
// everything it would refuse, what is missing, and what would be written. Reads only, or carries it out and takes it
// back.
int drive_check_command(const DriveOptions& options);
// A drive type from the maker's electronic data sheet, and in words what the drive lacks; needs no bus.
int drive_type_command(const DriveOptions& options);
// Boots a drive, enables it, turns its motor a short way, and disables it; only when somebody has said so.
int drive_jog_command(const DriveOptions& options);

struct RobotCheckOptions {
  std::string robot = "zhu2022";
  std::string bus;       // empty: as for a run
  std::string scene;     // whose payload a serial arm carries; empty: none
  std::string svg_file;  // empty: no picture
  bool json = false;
};
// What of a robot fits: capacity, bus load, workspace, tensions at its poses, holes, fixtures; exit code 1 when
// something does not, which it names. Cost: about a second for the workspace.
int robot_check_command(const RobotCheckOptions& options);

struct RobotNewOptions {
  std::string name;  // of the robot
  std::string file;  // empty: NAME.lua
  // Empty: asked for where a person sits there, else a usual value.
  std::string segments, modules, module_length_m, radius_m, cables, theta_limit_deg;
};
// Writes a commented robot table from a few answers and prints its path.
int robot_new_command(const RobotNewOptions& options);

struct DoctorOptions {
  bool json = false;
};
// What this host can and cannot do, and what to do about it; exit code 0 always, it only tells.
int doctor_command(const DoctorOptions& options);

// What --help tells of one command, for completion.
struct CommandHelp {
  struct Word {
    std::string name;   // of an option or a command below this one
    std::string about;  // its sentence
  };
  std::string path;  // "liana", "liana robot export"
  std::vector<Word> words;
};

// Completion of `liana` on standard output for a shell, bash or zsh; or, what completion itself asks for, the names
// that there are of robots, scenes, buses or missions.
int completion_command(const std::string& what, const std::vector<CommandHelp>& commands);

}  // namespace liana::cli
