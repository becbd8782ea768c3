// lianad: the real-time thread with the core and the buses, and the service side with the API socket.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "host/api/registry.hpp"
#include "host/calibration/calibration.hpp"
#include "host/command_line/command_line.hpp"
#include "host/control/last_stop.hpp"
#include "host/control/realtime.hpp"
#include "host/control/rt_cycle.hpp"
#include "host/daemon/service.hpp"

namespace {

using namespace liana;

constexpr double kExpectTimeout_s = 60.0;
constexpr double kStopLimit_s = 10.0;  // of arm time, until the drives are off after a failure

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

// A side that has failed ends the run; before that, the arm is stopped and its drives are off.
[[noreturn]] void end_after_stop(const std::string& side, const std::string& problem) {
  throw std::runtime_error(side + " failed, so the arm was stopped: " + problem);
}

// Fast and paced: one thread alternates service and real-time side, so that runs repeat bit for bit. False when the bus
// has ended.
bool alternate(Service& service, RtCycle& cycle) {
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

bool run_lockstep(Service& service, RtCycle& cycle, Link& link, std::uint64_t stop_limit_ticks) {
  try {
    return alternate(service, cycle);
  } catch (const std::exception& error) {
    stop_without_service(link, stop_limit_ticks, [&] { return cycle.run_tick(); });
    end_after_stop("the service side", error.what());
  }
}

// The service runs once per command interval, when the real-time thread has published its image.
void serve_beside(const ThreadEnd& realtime, Service& service) {
  while (!realtime.over && !service.finished()) {
    if (g_signal != 0) service.begin_shutdown("signal");
    if (service.interval_began()) service.cycle();
    service.idle(0.001);
  }
}

// Real: two threads, each of which ends the motion when the other one fails.
bool run_real(Service& service, RtCycle& cycle, Link& link, std::uint64_t stop_limit_ticks) {
  ThreadEnd end;
  const std::jthread realtime = start_realtime(
      [&cycle](const std::stop_token& stop) {
        while (!stop.stop_requested() && cycle.run_tick()) {
        }
      },
      end);
  try {
    serve_beside(end, service);
  } catch (const std::exception& error) {
    stop_without_service(link, stop_limit_ticks, [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return !end.over;
    });
    end_after_stop("the service side", error.what());
  }
  if (!end.over || end.problem.empty()) return service.finished();
  // Without ticks the drives hear nothing more and stop by themselves.
  service.stop_by_itself("the real-time thread failed: " + end.problem);
  service.take_leave();
  end_after_stop("the real-time thread", end.problem);
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
  const auto stop_limit = static_cast<std::uint64_t>(kStopLimit_s / robot.table.tick_s);
  const bool finished = *mode == TimeMode::kReal ? run_real(service, *cycle, *link, stop_limit)
                                                 : run_lockstep(service, *cycle, *link, stop_limit);
  service.take_leave();
  if (!finished) throw std::runtime_error("the bus has ended: liana-bus or the bench left");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CommandLine line("lianad: control core, buses, verification and API of a cable-driven arm");
  line.option("--robot", options.robot, "robot JSON (docs/formats.md)").required();
  line.option("--scene", options.scene, "scene JSON").required();
  line.option("--buses", options.buses, "buses JSON").required();
  line.option("--api", options.api, "path of the API socket to listen at").required();
  line.option("--time", options.time, "fast, paced or real").with_default_shown();
  line.option("--physics", options.physics, "friction the core is told: nominal, ideal or worn").with_default_shown();
  line.option("--bus-socket", options.bus_socket, "socket of liana-bus (embedded back end)");
  line.option("--calibration", options.calibration,
              "what liana calibrate measured of this arm's drives; the robot table's values without");
  line.option("--in-pose", options.in_pose,
              "named pose in which the arm lies in its fixture: unless every cable says so, the arm is not enabled");
  line.option("--expect", options.expect, "roles that must have connected before virtual time starts, comma separated");
  if (const auto code = line.parse(argc, argv)) return *code;
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lianad: %s\n", error.what());
    return 1;
  }
}
