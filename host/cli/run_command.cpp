#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "host/cli/commands.hpp"
#include "host/json/json.hpp"
#include "host/report/run_report.hpp"
#include "host/system/errors.hpp"
#include "host/system/output.hpp"
#include "host/system/run_session.hpp"
#include "host/system/system_layout.hpp"

namespace liana::cli {
namespace {

report::Criteria criteria(const std::string& robot_file, const std::string& physics) {
  std::ifstream file(robot_file);
  return report::criteria_of(Json::parse_or_null(std::string{std::istreambuf_iterator<char>(file), {}}), physics);
}

Json report_of(const system::RunOptions& options, const system::SystemLayout& plan, const system::RunSession& session,
               const system::RunEnd& end) {
  report::ReportSources sources;
  sources.robot = options.robot;
  sources.mission = options.mission;
  sources.physics = options.physics;
  sources.seed = options.seed;
  sources.outcome = end.outcome;
  sources.reason = end.message.substr(0, end.message.find('\n'));
  sources.time_mode = plan.time_mode;
  sources.truth_file = plan.file("truth.bin");
  sources.bench_summary_file = plan.file("bench_summary.json");
  sources.mission_report_file = plan.file("mission.json");
  sources.bus_stats_file = plan.file("bus_stats.json");
  sources.states = session.states();
  sources.claims = session.claims();
  sources.announced = session.announced();
  sources.welcome = &session.welcome();
  sources.last_state = &session.last_state();
  if (plan.scene.rod) sources.rod = plan.scene.rod->pose;
  sources.criteria = criteria(plan.file("robot.json"), options.physics);
  return report::make_report(sources);
}

// The place was writable when the run began; what happened to it since must not lose the rest of the report.
bool write_report(const std::string& path, const Json& report) {
  try {
    system::write_output(path, report.dump(1) + "\n");
    return true;
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "liana: the report is lost: %s\n", error.what());
    return false;
  }
}

bool publish_report(const system::RunOptions& options, const system::SystemLayout& plan, const Json& report) {
  bool written = !plan.keep_directory || write_report(plan.file("report.json"), report);
  if (options.report_file == "-") {
    std::puts(report.dump().c_str());
    return written;
  }
  if (!options.report_file.empty()) written = write_report(options.report_file, report) && written;
  std::fputs(report::report_text(report).c_str(), stdout);
  return written;
}

// Without lianad there are logs only.
std::string where_to_look(const system::SystemLayout& plan) {
  if (!std::filesystem::exists(plan.events_file())) return "its logs are kept in " + plan.directory;
  return "what happened and why is in " + plan.events_file() + ", its logs are beside it";
}

}  // namespace

int run_command(const system::RunOptions& options) {
  const system::SystemLayout plan = system::make_layout(options);
  system::RunSession session(plan);
  const system::RunEnd end = session.run();
  if (end.bad_input) {
    system::clean_up(plan, true);
    throw system::BadInput(end.message);
  }
  const Json report = report_of(options, plan, session, end);
  const bool written = publish_report(options, plan, report);
  const bool success = report.value("outcome", "") == "success";
  if (!end.message.empty()) std::fprintf(stderr, "liana: %s\n", end.message.c_str());
  if (!success) {
    std::fprintf(stderr, "liana: the run did not succeed; %s%s\n", where_to_look(plan).c_str(),
                 plan.keep_directory ? "" : "; delete the folder when you have looked");
  }
  system::clean_up(plan, success);
  return success && written ? system::kExitOk : system::kExitFailure;
}

}  // namespace liana::cli
