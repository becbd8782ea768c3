// liana-bench: simulated drives and arm on the other end of the bus.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "hil/arm/arm_physics.hpp"
#include "hil/bench/bench.hpp"
#include "hil/bench/data_sheet_file.hpp"
#include "hil/bus/embedded_bus.hpp"
#include "hil/bus/socketcan_bus.hpp"

namespace {

constexpr int kBadInput = 2;      // exit code
constexpr double kRunOn_s = 0.5;  // longer than every deadline of the drives

struct Paths {
  std::string robot;
  std::string scene;
  std::string buses;
  std::string faults;
  std::string bus_socket;
  std::string can;
  std::string cross_wired;
  std::string scene_offset;
  std::string data_sheet;
};

std::string whole_number_problem(const std::string& text) {
  const bool is_whole = text.find_first_not_of("0123456789") == std::string::npos;
  return is_whole ? "" : "'" + text + "': allowed: a whole number, 0 or more";
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

void declare(CLI::App& app, Paths& paths, liana::bench::BenchOptions& options, bool& no_spread, bool& is_check) {
  app.add_option("--robot", paths.robot, "robot JSON");
  app.add_option("--scene", paths.scene, "scene JSON");
  app.add_option("--buses", paths.buses, "bus table JSON");
  auto* socket = app.add_option("--bus-socket", paths.bus_socket, "socket of liana-bus");
  auto* can = app.add_option("--can", paths.can, "SocketCAN interfaces, e.g. vcan0,vcan1; alone: the bus table's names")
                  ->expected(0, 1);
  socket->excludes(can);
  app.add_option("--api", options.api_socket, "API socket of lianad, for the tip camera");
  app.add_option("--arm", options.arm,
                 "arm model: full, or light for slow machines (no inertia, no contact; with --physics ideal only)")
      ->capture_default_str();
  app.add_option("--physics", options.physics, "friction: nominal, ideal or worn")->capture_default_str();
  app.add_option("--seed", options.seed, "true parameters, start offset and noise; 0 or more")
      ->check(whole_number_problem)  // -1 would wrap
      ->capture_default_str();
  app.add_option("--truth", options.truth_path, "write truth rows here");
  app.add_option("--summary", options.summary_path, "write a JSON summary here at the end");
  app.add_option("--faults", paths.faults, "JSON list of faults to inject");
  app.add_option("--practice", options.practice_socket, "listen here for faults that begin at once, while it runs");
  app.add_option("--start-pose", options.start_pose, "named pose to start from, or all angles in degrees, t1,t2,...")
      ->capture_default_str();
  app.add_option("--free-step", options.free_step_s,
                 "longest step of the full arm's physics while it can touch nothing, s: 0.002 for a dry run")
      ->check(within(liana::bench::ArmPhysics::kStep_s, liana::bench::ArmPhysics::kLongestStep_s))
      ->capture_default_str();
  app.add_option("--run-on", options.run_on_s,
                 "seconds that drives and arm go on after the bus has ended, in truth and summary")
      ->check(within(0.0, 60.0))
      ->capture_default_str();
  app.add_option("--rest-within", options.rest_within_s,
                 "seconds that they go on after that at most, until the arm is at rest")
      ->check(within(0.0, 600.0))
      ->capture_default_str();
  app.add_option("--scene-offset", paths.scene_offset,
                 "MM,DEG: the scene really is so far from where its table has it, in a direction drawn from the seed");
  app.add_option("--gravity", options.gravity_share,
                 "share of the arm's weight that counterweights leave, from 0 to 1; down is -z of the base frame")
      ->check(within(0.0, 1.0));
  app.add_option("--linkage-error", options.linkage_error,
                 "share by which the joints of a segment bend unevenly at most, from 0 to 0.5, drawn from the seed")
      ->check(within(0.0, 0.5));
  app.add_flag("--jig", options.fixture, "the arm starts exactly in its start pose");
  app.add_flag_callback("--fixture", [] { throw CLI::ValidationError("--fixture", "this option is called --jig now"); })
      ->group("");
  app.add_option("--cross-wired", paths.cross_wired,
                 "two drives, counted from 1, e.g. 4,5, that have each other's cable");
  app.add_flag("--no-spread", no_spread, "the arm is exactly as the table says (for tests)");
  app.add_flag("--check", is_check, "look at all that is given, and end");
  app.add_option("--eds", paths.data_sheet,
                 "write the data sheet of its drives (EDS, CiA 306) here, - is standard output, and end");
}

// What is missing among the options; empty: nothing.
std::string missing_option(const CLI::App& app, const Paths& paths) {
  for (const char* table : {"--robot", "--scene", "--buses"})
    if (app.count(table) == 0) return std::string(table) + " is required";
  if (paths.bus_socket.empty() && app.count("--can") == 0)
    return "say where the bus is: --bus-socket PATH or --can [IF,IF]";
  return "";
}

int write_data_sheet(const std::string& path) {
  try {
    liana::bench::write_data_sheet(path);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "liana-bench: --eds: " << error.what() << '\n';
    return kBadInput;
  }
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    parts.push_back(list.substr(from, comma - from));
    from = comma + 1;
  }
  return parts;
}

std::vector<std::size_t> two_drives(const std::string& list, std::size_t count) {
  std::vector<std::size_t> drives;
  const std::vector<std::string> parts = split(list);
  for (const std::string& part : parts) {
    const bool number = !part.empty() && part.size() < 4 && part.find_first_not_of("0123456789") == std::string::npos;
    if (number && std::stoul(part) >= 1 && std::stoul(part) <= count) drives.push_back(std::stoul(part) - 1);
  }
  if (parts.size() == 2 && drives.size() == 2 && drives[0] != drives[1]) return drives;
  throw std::runtime_error("--cross-wired: \"" + list + "\"; allowed are two different drives from 1 to " +
                           std::to_string(count) + ", e.g. 4,5");
}

double number_up_to(const std::string& text, double most) {
  std::size_t end = 0;
  const double value = text.empty() ? -1.0 : std::stod(text, &end);
  return end == text.size() && value <= most ? value : -1.0;
}

liana::bench::SceneOffset scene_offset(const std::string& text) {
  constexpr double kMost_mm = 1000.0, kMost_deg = 45.0, kRadPerDeg = 3.14159265358979323846 / 180.0;
  const std::vector<std::string> parts = split(text);
  if (parts.size() == 2) {
    try {
      const double mm = number_up_to(parts[0], kMost_mm), deg = number_up_to(parts[1], kMost_deg);
      if (mm >= 0.0 && deg >= 0.0) return {1e-3 * mm, kRadPerDeg * deg};
    } catch (const std::logic_error&) {  // no number
    }
  }
  throw std::runtime_error("--scene-offset: \"" + text +
                           "\"; allowed are mm from 0 to 1000 and deg from 0 to 45, e.g. 10,1");
}

std::unique_ptr<liana::bench::Bus> open_bus(const Paths& paths, const liana::bench::BusesConfig& buses) {
  if (!paths.bus_socket.empty())
    return std::make_unique<liana::bench::EmbeddedBus>(paths.bus_socket, buses.period_us, buses.names.size());
  const auto interfaces = paths.can.empty() ? buses.names : split(paths.can);
  if (interfaces.size() != buses.names.size())
    throw std::runtime_error("--can: " + std::to_string(interfaces.size()) + " interfaces for " +
                             std::to_string(buses.names.size()) + " buses of the table; name one for each");
  return std::make_unique<liana::bench::SocketCanBus>(interfaces, buses.period_us);
}

void load_arm(const std::string& path, liana::bench::BenchOptions& options) {
  if (liana::bench::is_serial_robot(path)) {
    options.serial_robot = liana::bench::load_serial_robot(path);
  } else {
    options.robot = liana::bench::load_robot(path);
  }
}

std::size_t drives_of(const liana::bench::BenchOptions& options) {
  return options.serial_robot ? options.serial_robot->drives.size() : options.robot.drive_count();
}

// Angles that a fault can wait for.
std::size_t angles_of(const liana::bench::BenchOptions& options) {
  return options.serial_robot ? options.serial_robot->joints.size() : options.robot.theta_count();
}

// What fails here is no longer what was given.
int run(liana::bench::Bench& bench, liana::bench::Bus& bus) {
  try {
    bench.run(bus);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "liana-bench: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Simulated CiA 402 drives and arm physics on the other end of the bus"};
  app.set_version_flag("--version", "liana-bench " LIANA_VERSION, "say which version");
  Paths paths;
  liana::bench::BenchOptions options;
  bool no_spread = false, is_check = false;
  options.run_on_s = kRunOn_s;
  declare(app, paths, options, no_spread, is_check);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "liana-bench: " << error.what() << "; see liana-bench --help\n";
    return kBadInput;
  }
  if (!paths.data_sheet.empty()) return write_data_sheet(paths.data_sheet);
  if (const std::string missing = missing_option(app, paths); !missing.empty()) {
    std::cerr << "liana-bench: " << missing << "; see liana-bench --help\n";
    return kBadInput;
  }
  liana::bench::end_on_signals();
  try {
    load_arm(paths.robot, options);
    options.scene = liana::bench::load_scene(paths.scene);
    options.buses = liana::bench::load_buses(paths.buses);
    if (!paths.faults.empty())
      options.faults = liana::bench::load_faults(paths.faults, drives_of(options), angles_of(options));
    options.spread = !no_spread;
    if (!paths.scene_offset.empty()) options.scene_offset = scene_offset(paths.scene_offset);
    if (!paths.cross_wired.empty()) options.cross_wired = two_drives(paths.cross_wired, drives_of(options));
    liana::bench::Bench bench(options);
    if (is_check) return 0;
    const auto bus = open_bus(paths, options.buses);
    return run(bench, *bus);
  } catch (const std::exception& error) {
    std::cerr << "liana-bench: " << error.what() << '\n';
    return kBadInput;
  }
}
