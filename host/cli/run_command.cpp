#include <cstdio>
#include <filesystem>

#include "host/cli/commands.hpp"
#include "host/report/run_report.hpp"
#include "host/system/errors.hpp"
#include "host/system/output.hpp"
#include "host/system/run_session.hpp"
#include "host/system/system_layout.hpp"

namespace liana {
namespace {

Json report_of(const RunOptions& options, const SystemLayout& plan, const RunSession& session, const RunEnd& end) {
  ReportSources sources;
  sources.robot = options.robot;
  sources.mission = options.mission;
  sources.physics = options.physics;
  sources.seed = options.seed;
  sources.outcome = end.outcome;
  sources.reason = end.message.substr(0, end.message.find('\n'));
  sources.time_mode = plan.time_mode;
  sources.truth_file = plan.file("truth.bin");
  sources.mission_report_file = plan.file("mission.json");
  sources.bus_stats_file = plan.file("bus_stats.json");
  sources.states = session.states();
  sources.announced = session.announced();
  sources.welcome = &session.welcome();
  sources.last_state = &session.last_state();
  if (plan.scene.rod) sources.rod = plan.scene.rod->pose;
  return make_report(sources);
}

// The place was writable when the run began; what happened to it since must not lose the rest of the report.
bool write_report(const std::string& path, const Json& report) {
  try {
    write_output(path, report.dump(1) + "\n");
    return true;
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "liana: the report is lost: %s\n", error.what());
    return false;
  }
}

bool publish_report(const RunOptions& options, const SystemLayout& plan, const Json& report) {
  bool written = !plan.keep_directory || write_report(plan.file("report.json"), report);
  if (options.report_file == "-") {
    std::puts(report.dump().c_str());
    return written;
  }
  if (!options.report_file.empty()) written = write_report(options.report_file, report) && written;
  std::fputs(report_text(report).c_str(), stdout);
  return written;
}

// Without lianad there are logs only.
std::string where_to_look(const SystemLayout& plan) {
  if (!std::filesystem::exists(plan.events_file())) return "its logs are kept in " + plan.directory;
  return "what happened and why is in " + plan.events_file() + ", its logs are beside it";
}

}  // namespace

int run_command(const RunOptions& options) {
  const SystemLayout plan = make_layout(options);
  RunSession session(plan);
  const RunEnd end = session.run();
  if (end.bad_input) {
    clean_up(plan, true);
    throw BadInput(end.message);
  }
  const Json report = report_of(options, plan, session, end);
  const bool written = publish_report(options, plan, report);
  const bool success = report.value("outcome", "") == "success";
  if (!end.message.empty()) std::fprintf(stderr, "liana: %s\n", end.message.c_str());
  if (!success) {
    std::fprintf(stderr, "liana: the run did not succeed; %s%s\n", where_to_look(plan).c_str(),
                 plan.keep_directory ? "" : "; delete the folder when you have looked");
  }
  clean_up(plan, success);
  return success && written ? kExitOk : kExitFailure;
}

}  // namespace liana
