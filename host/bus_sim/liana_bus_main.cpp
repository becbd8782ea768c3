// liana-bus: the embedded CAN bus (docs/bus-protocol.md).
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>

#include "host/bus_sim/bus_hub.hpp"
#include "host/bus_sim/bus_listener.hpp"
#include "host/bus_sim/bus_process.hpp"

namespace {

struct Arguments {
  std::string socket;
  std::string buses;
  std::string time = "fast";
  std::string log_directory;
  std::string script;
  std::string stats;
};

void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { liana::request_bus_stop(); };  // without SA_RESTART: blocking calls return
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void run(const Arguments& arguments) {
  liana::BusHubOptions options;
  options.time_mode = *liana::time_mode_from(arguments.time);
  options.log_directory = arguments.log_directory;
  liana::load_wires(arguments.buses, options);
  if (!arguments.script.empty())
    options.script = liana::load_fault_script(arguments.script, static_cast<int>(options.wires.size()));
  std::vector<liana::Participant> participants =
      liana::admit_participants(arguments.socket, liana::welcome_of(options));
  if (participants.size() < 2) return;
  liana::BusHub hub(options, std::move(participants));
  if (options.time_mode == liana::TimeMode::kReal) {
    liana::run_real(hub);
  } else {
    liana::run_lockstep(hub, options.time_mode == liana::TimeMode::kPaced);
  }
  if (!arguments.stats.empty()) liana::write_bus_stats(arguments.stats, hub);
  std::fprintf(stderr, "liana-bus: %s after %.3f s\n", hub.end_reason().c_str(),
               static_cast<double>(hub.now_ns) * 1e-9);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "The embedded CAN bus: exact bit timing, arbitration and bounded queues between lianad and the bench, and "
      "virtual time.",
      "liana-bus");
  Arguments arguments;
  app.add_option("--socket", arguments.socket, "Path of the local socket to listen on")->required();
  app.add_option("--buses", arguments.buses, "Bus table (JSON)")->required();
  app.add_option("--time", arguments.time, "How time passes")
      ->check(CLI::IsMember({"fast", "paced", "real"}))
      ->capture_default_str();
  app.add_option("--log", arguments.log_directory, "Directory for one candump log per bus");
  app.add_option("--script", arguments.script, "Scripted losses (JSON)");
  app.add_option("--stats", arguments.stats, "File for frames, bits and load per bus (JSON), written at the end");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  end_on_signals();
  try {
    run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-bus: %s\n", error.what());
    return 2;
  }
  return 0;
}
