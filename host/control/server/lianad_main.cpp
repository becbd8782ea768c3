// lianad: the real-time thread with the core and the buses, and the service side with the API socket.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "host/api/device/driver.hpp"
#include "host/api/server/registry.hpp"
#include "host/base/net/peer.hpp"
#include "host/base/options/command_line.hpp"
#include "host/base/text/text_output.hpp"
#include "host/control/realtime/last_stop.hpp"
#include "host/control/realtime/realtime.hpp"
#include "host/control/realtime/rt_cycle.hpp"
#include "host/control/server/cable_arm_server.hpp"
#include "host/control/server/serial_arm_server.hpp"
#include "host/control/server/turns.hpp"
#include "host/drives/calibration/calibration.hpp"
#include "host/drives/canopen/expected_drive.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/serial_robot.hpp"

namespace {

using namespace liana;

constexpr double kExpectTimeout_s = 60.0;
constexpr double kStopLimit_s = 10.0;  // of arm time, until the drives are off after a failure

constexpr unsigned int kStandstill_s = 5;  // of virtual time after a signal

volatile std::sig_atomic_t g_signal = 0;
void on_signal(int number) { g_signal = number; }

// In virtual time lianad waits for the bus, which may never answer again.
void on_signal_in_virtual_time(int number) {
  g_signal = number;
  ::alarm(kStandstill_s);
}

void on_standstill(int) {
  constexpr char kText[] = "lianad: ended by a signal while virtual time stood still; look at bus and bench\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText, sizeof kText - 1);
  ::_exit(EXIT_FAILURE);
}

// The first signal stops the arm and ends lianad, the second one kills.
void handle_signals(bool is_real) {
  struct sigaction action {};
  action.sa_handler = is_real ? on_signal : on_signal_in_virtual_time;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGINT, &action, nullptr);
  action.sa_handler = on_standstill;
  ::sigaction(SIGALRM, &action, nullptr);
}

struct Options {
  std::string robot, scene, buses, api, time = "fast", physics = "nominal", bus_socket, expect, calibration, in_pose,
                                        events, commands, retract_path, verify_times, group, devices, fixtures;
};

std::vector<liana::api::Role> roles_in(const std::string& list) {
  std::vector<liana::api::Role> roles;
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');) roles.push_back(liana::api::role_of(name));
  return roles;
}

// That status and estop do not find it by themselves is no reason not to run.
std::optional<liana::api::Registration> registered(const std::string& api) {
  try {
    return std::optional<liana::api::Registration>(std::in_place, api);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lianad: liana status and estop find this system only with --api %s: %s\n", api.c_str(),
                 error.what());
    return std::nullopt;
  }
}

int ended_by(const std::exception& problem, int code) {
  std::fprintf(stderr, "lianad: %s\n", problem.what());
  return code;
}

// What fails in `work` is no longer what was given.
template <class Work>
int failing(const Work& work) {
  try {
    work();
    return 0;
  } catch (const std::exception& problem) {
    return ended_by(problem, 1);
  }
}

// What is the same for every robot.
struct Setup {
  const Options& options;
  liana::timing::TimeMode mode;
  liana::config::BusesConfig buses;
  liana::config::SceneConfig scene;
  std::vector<liana::api::Role> expected;
};

std::optional<gid_t> group_of(const Options& options) {
  if (options.group.empty()) return std::nullopt;
  return api::group_named("--group", options.group);
}

liana::server::ServiceConfig service_config(const Setup& setup, const std::string& robot_json) {
  liana::server::ServiceConfig config;
  config.api_path = setup.options.api;
  config.api_group = group_of(setup.options);
  config.time_mode = setup.mode;
  config.robot_json = robot_json;
  config.scene_json = setup.scene.canonical_json;
  config.buses = setup.buses;
  config.events_file = setup.options.events;
  config.commands_file = setup.options.commands;
  config.way_file = setup.options.retract_path;
  if (!setup.options.calibration.empty()) config.calibration = liana::config::read_text_file(setup.options.calibration);
  config.verify_times_file = setup.options.verify_times;
  if (setup.scene.camera) config.camera_latency_s = setup.scene.camera->latency_s;
  const auto mission = std::find(setup.expected.begin(), setup.expected.end(), liana::api::Role::kMission);
  config.ends_with_mission = setup.mode != liana::timing::TimeMode::kReal && mission != setup.expected.end();
  return config;
}

// The API is there before the bus hears of us: the bench connects to it at its first wake-up.
template <class Arm, class Robot>
int serve(const Setup& setup, const Robot& robot, liana::realtime::ArmMailbox<Arm>& link,
          liana::server::ArmServer& desk) {
  std::unique_ptr<liana::realtime::RtCycle<Arm>> cycle;
  liana::server::ServiceConfig config = service_config(setup, robot.canonical_json);
  if constexpr (std::is_same_v<Robot, liana::config::RobotConfig>) {
    config.drive_names = liana::config::DriveNames(robot);
  } else {
    config.drive_names = liana::config::DriveNames(setup.buses.places());
  }
  config.boot_problems = [&] { return cycle->line().boot_problems(); };
  config.unwatched = [&] { return cycle->line().unwatched(); };
  config.serials = [&] { return cycle->line().serials(); };
  liana::server::Service service(config, desk);
  const std::optional<liana::api::Registration> registration = registered(setup.options.api);
  const std::unique_ptr<liana::bus::DriveBus> bus =
      liana::bus::open_drive_bus(setup.buses, setup.mode, setup.options.bus_socket);
  cycle = std::make_unique<liana::realtime::RtCycle<Arm>>(robot.table, canopen::drive_expectations(robot, setup.buses),
                                                          setup.buses, *bus, link);
  const bool is_real = setup.mode == liana::timing::TimeMode::kReal;
  handle_signals(is_real);
  const auto stop_limit = static_cast<std::uint64_t>(kStopLimit_s / robot.table.tick_s);
  const liana::server::Signalled signalled = [] { return g_signal != 0; };
  const liana::server::Ticks ticks{
      [&] {
        if (!is_real && g_signal != 0) ::alarm(kStandstill_s);  // time goes on
        return cycle->run_tick();
      },
      [&](const std::function<bool()>& next) { liana::realtime::stop_without_service(link, stop_limit, next); }};
  return failing([&] {
    if (!is_real && !service.wait_for(setup.expected, kExpectTimeout_s, signalled)) return;
    const bool finished = is_real ? liana::server::run_real(service, ticks, signalled)
                                  : liana::server::run_lockstep(service, ticks, signalled);
    service.flush_and_close();
    if (!finished) throw std::runtime_error("the bus has ended: liana-bus or the bench left");
  });
}

device::DeviceEndpoint devices_of(const Options& options) {
  return {options.devices.empty() ? device::devices_path(options.api) : options.devices, group_of(options)};
}

int serve_cable_arm(const Setup& setup) {
  const Options& options = setup.options;
  liana::config::RobotConfig robot = liana::config::load_robot(options.robot, options.physics, setup.buses);
  if (!options.calibration.empty()) {
    liana::calibration::apply(
        liana::calibration::load_calibration(options.calibration, robot, liana::calibration::today_utc()), robot);
  }
  const auto link = std::make_unique<liana::realtime::ArmMailbox<cable::CableArm>>(robot.table);
  liana::server::CableArmServer desk(robot, setup.scene, options.in_pose, setup.mode, *link, devices_of(options));
  if (options.fixtures == "off") desk.leave_out_fixtures();
  return serve(setup, robot, *link, desk);
}

int serve_serial_arm(const Setup& setup) {
  const Options& options = setup.options;
  const auto refuse = [](const char* name, const std::string& value, const char* why) {
    if (!value.empty())
      throw std::runtime_error(std::string(name) + ": allowed with cable arms only: " + why + "; leave it out");
  };
  refuse("--calibration", options.calibration, "the encoders of a serial arm are absolute");
  refuse("--in-pose", options.in_pose, "the encoders of a serial arm are absolute");
  refuse("--devices", options.devices, "no device steers a serial arm yet");
  refuse("--fixtures", options.fixtures, "no hand steers a serial arm yet");
  const liana::config::SerialRobotConfig robot = liana::config::load_serial_robot(options.robot, setup.buses);
  const auto link = std::make_unique<liana::realtime::ArmMailbox<serial::SerialArm>>(robot.table);
  liana::server::SerialArmServer desk(robot, setup.scene, setup.mode, *link);
  return serve(setup, robot, *link, desk);
}

int run(const Options& options) {
  const std::optional<liana::timing::TimeMode> mode = liana::timing::time_mode_from(options.time);
  if (!mode) throw std::runtime_error("--time " + options.time + ": allowed fast, paced, real");
  const Setup setup{options, *mode, liana::config::load_buses(options.buses), liana::config::load_scene(options.scene),
                    roles_in(options.expect)};
  const bool is_serial = liana::config::is_serial_robot(options.robot);
  if (*mode == liana::timing::TimeMode::kReal) {
    const int code = failing([] {
      liana::realtime::lock_memory();
      liana::realtime::come_before_ordinary_work();
    });
    if (code != 0) return code;
  }
  return is_serial ? serve_serial_arm(setup) : serve_cable_arm(setup);
}

}  // namespace

int main(int argc, char** argv) {
  liana::text::print_only_text();
  Options options;
  liana::options::CommandLine line("lianad: control core, buses, verification and API of an arm");
  line.option("--robot", options.robot, "robot JSON (docs/reference/formats.md)").required();
  line.option("--scene", options.scene, "scene JSON").required();
  line.option("--buses", options.buses, "buses JSON").required();
  line.option("--api", options.api, "path of the API socket to listen at").required();
  line.option("--devices", options.devices,
              "path of the socket to listen at for input devices (docs/reference/device-protocol.md); .devices behind "
              "that of --api without");
  line.option("--group", options.group, "group whose members may use API and devices, beside its own user and root");
  line.option("--time", options.time, "fast, paced or real").with_default_shown();
  line.option("--physics", options.physics, "friction the core is told: nominal, ideal or worn").with_default_shown();
  line.option("--bus-socket", options.bus_socket, "socket of liana-bus (embedded back end)");
  line.option("--calibration", options.calibration,
              "what liana calibrate measured of this arm's drives; the robot table's values without");
  line.option("--in-pose", options.in_pose,
              "named pose in which the arm lies in its jig: unless every cable says so, the arm is not enabled");
  line.option("--fixtures", options.fixtures,
              "off: no fixture of the scene guides a hand or is felt, whatever is asked")
      .one_of({"on", "off"});
  line.option("--events", options.events, "file for what happened and why, a line for each event");
  line.option("--commands", options.commands, "file for what becomes of every command, a line for each stage");
  line.option(
      "--retract-path", options.retract_path,
      "file that keeps the verified way back, so that it survives lianad: read at the start, used where the arm "
      "is enabled within 50 mm of it");
  line.option("--verify-times", options.verify_times,
              "file for how long each command took from setpoint to release, us of this machine's time");
  line.option("--expect", options.expect, "roles that must have connected before virtual time starts, comma separated");
  if (const auto code = line.parse(argc, argv)) return *code;
  try {
    return run(options);
  } catch (const std::exception& problem) {
    return ended_by(problem, 2);
  }
}
