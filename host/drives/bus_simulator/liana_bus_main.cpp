// liana-bus: the embedded CAN bus (docs/reference/bus-protocol.md).
#include <csignal>
#include <cstdio>
#include <exception>

#include "host/base/options/command_line.hpp"
#include "host/base/text/text_output.hpp"
#include "host/drives/bus_simulator/bus_hub.hpp"
#include "host/drives/bus_simulator/bus_listener.hpp"
#include "host/drives/bus_simulator/bus_process.hpp"

using namespace liana::bus_simulator;

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
  action.sa_handler = [](int) { request_bus_stop(); };  // without SA_RESTART: blocking calls return
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// What fails here is no longer what was given.
int serve(const Arguments& arguments, liana::timing::TimeMode mode, BusHub& hub) {
  try {
    if (mode == liana::timing::TimeMode::kReal) {
      run_real(hub);
    } else {
      run_lockstep(hub, mode == liana::timing::TimeMode::kPaced);
    }
    if (!arguments.stats.empty()) write_bus_stats(arguments.stats, hub);
    std::fprintf(stderr, "liana-bus: %s after %.3f s\n", hub.end_reason().c_str(),
                 static_cast<double>(hub.now_ns) * 1e-9);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-bus: %s\n", error.what());
    return 1;
  }
}

int run(const Arguments& arguments) {
  BusHubOptions options;
  options.time_mode = *liana::timing::time_mode_from(arguments.time);
  options.log_directory = arguments.log_directory;
  load_wires(arguments.buses, options);
  if (!arguments.script.empty())
    options.script = load_fault_script(arguments.script, static_cast<int>(options.wires.size()));
  std::vector<Participant> participants = admit_participants(arguments.socket, welcome_of(options));
  if (participants.size() < 2) return 0;
  BusHub hub(options, std::move(participants));
  return serve(arguments, options.time_mode, hub);
}

}  // namespace

int main(int argc, char** argv) {
  liana::text::print_only_text();
  liana::options::CommandLine line(
      "The embedded CAN bus: exact bit timing, arbitration and bounded queues between lianad and the bench, and "
      "virtual time.",
      "liana-bus");
  Arguments arguments;
  line.option("--socket", arguments.socket, "Path of the local socket to listen on").required();
  line.option("--buses", arguments.buses, "Bus table (JSON)").required();
  line.option("--time", arguments.time, "How time passes").one_of({"fast", "paced", "real"}).with_default_shown();
  line.option("--log", arguments.log_directory, "Directory for one candump log per bus").existing_folder();
  line.option("--script", arguments.script, "Scripted losses (JSON)");
  line.option("--stats", arguments.stats, "File for frames, bits and load per bus (JSON), written at the end");
  if (const auto code = line.parse(argc, argv)) return *code == 0 ? 0 : 2;
  end_on_signals();
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-bus: %s\n", error.what());
    return 2;
  }
}
