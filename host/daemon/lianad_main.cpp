// lianad: the real-time thread with the core and the buses, and the service side with the API socket.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>

#include "host/api/registry.hpp"
#include "host/calibration/calibration.hpp"
#include "host/control/realtime.hpp"
#include "host/control/rt_cycle.hpp"
#include "host/daemon/service.hpp"

namespace {

using namespace liana;

constexpr double kExpectTimeout_s = 60.0;

volatile std::sig_atomic_t g_signal = 0;
void on_signal(int number) { g_signal = number; }

// The first signal stops the arm and ends lianad, the second one kills.
void handle_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGINT, &action, nullptr);
}

struct Options {
  std::string robot, scene, buses, api, time = "fast", physics = "nominal", bus_socket, expect, calibration, in_pose;
};

std::vector<Role> roles_in(const std::string& list) {
  std::vector<Role> roles;
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');) roles.push_back(role_of(name));
  return roles;
}

// Virtual time stands still now. Clients may read the last state until somebody sends shutdown.
void wait_for_dismissal(Service& service) {
  constexpr double kPatience_s = 30.0, kLook_s = 0.05;
  service.end_lockstep();
  for (double waited_s = 0.0; waited_s < kPatience_s && !service.dismissed() && g_signal == 0; waited_s += kLook_s)
    service.idle(kLook_s);
}

// Fast and paced: one thread alternates service and real-time side, so that runs repeat bit for bit. False when the bus
// has ended.
bool run_lockstep(Service& service, RtCycle& cycle) {
  for (;;) {
    if (g_signal != 0) service.begin_shutdown("signal");
    service.cycle();
    if (service.finished()) {
      wait_for_dismissal(service);
      return true;
    }
    do {
      if (!cycle.run_tick()) return false;
    } while (!service.interval_began());
  }
}

// Real: two threads. The service runs once per command interval, when the real-time thread has published its image.
bool run_real(Service& service, RtCycle& cycle) {
  std::atomic<bool> stop{false}, ended{false};
  std::thread realtime = start_realtime([&] {
    while (!stop.load(std::memory_order_relaxed) && cycle.run_tick()) {
    }
    ended = true;
  });
  while (!ended && !service.finished()) {
    if (g_signal != 0) service.begin_shutdown("signal");
    if (service.interval_began()) service.cycle();
    service.idle(0.001);
  }
  const bool finished = service.finished();
  stop = true;
  realtime.join();
  return finished;
}

// That status and estop do not find it by themselves is no reason not to run.
std::optional<Registration> registered(const std::string& api) {
  try {
    return std::optional<Registration>(std::in_place, api);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lianad: liana status and estop find this system only with --api %s: %s\n", api.c_str(),
                 error.what());
    return std::nullopt;
  }
}

int run(const Options& options) {
  const std::optional<TimeMode> mode = time_mode_from(options.time);
  if (!mode) throw std::runtime_error("--time " + options.time + ": allowed fast, paced, real");
  const BusesConfig buses = load_buses(options.buses);
  RobotConfig robot = load_robot(options.robot, options.physics, buses);
  if (!options.calibration.empty()) apply(load_calibration(options.calibration, robot, today_utc()), robot);
  const SceneConfig scene = load_scene(options.scene);
  const std::vector<Role> expected = roles_in(options.expect);

  if (*mode == TimeMode::kReal) lock_memory();
  // The API is there before the bus hears of us: the bench connects to it at its first wake-up.
  const auto link = std::make_unique<Link>(robot.table);
  std::unique_ptr<RtCycle> cycle;
  const bool ends_with_mission =
      *mode != TimeMode::kReal && std::find(expected.begin(), expected.end(), Role::kMission) != expected.end();
  Service service({options.api, *mode, robot, scene, buses, options.in_pose, ends_with_mission,
                   [&] { return cycle->boot_problems(); }, [&] { return cycle->serials(); }},
                  *link);
  const std::optional<Registration> registration = registered(options.api);
  const std::unique_ptr<DriveBus> bus = open_drive_bus(buses, *mode, options.bus_socket);
  cycle = std::make_unique<RtCycle>(robot, buses, *bus, *link);
  handle_signals();
  if (*mode != TimeMode::kReal) service.wait_for(expected, kExpectTimeout_s);
  const bool finished = *mode == TimeMode::kReal ? run_real(service, *cycle) : run_lockstep(service, *cycle);
  service.take_leave();
  if (!finished) throw std::runtime_error("the bus has ended: liana-bus or the bench left");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"lianad: control core, buses, verification and API of a cable-driven arm"};
  app.add_option("--robot", options.robot, "robot JSON (docs/formats.md)")->required();
  app.add_option("--scene", options.scene, "scene JSON")->required();
  app.add_option("--buses", options.buses, "buses JSON")->required();
  app.add_option("--api", options.api, "path of the API socket to listen at")->required();
  app.add_option("--time", options.time, "fast, paced or real")->capture_default_str();
  app.add_option("--physics", options.physics, "friction the core is told: nominal, ideal or worn")
      ->capture_default_str();
  app.add_option("--bus-socket", options.bus_socket, "socket of liana-bus (embedded back end)");
  app.add_option("--calibration", options.calibration,
                 "what liana calibrate measured of this arm's drives; the robot table's values without");
  app.add_option("--in-pose", options.in_pose,
                 "named pose in which the arm lies in its fixture: unless every cable says so, the arm is not enabled");
  app.add_option("--expect", options.expect,
                 "roles that must have connected before virtual time starts, comma separated");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lianad: %s\n", error.what());
    return 1;
  }
}
