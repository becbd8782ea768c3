#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "host/apps/cli/check_report.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/session_report.hpp"
#include "host/apps/launcher/errors.hpp"

namespace liana::cli {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<double> numbers_in(const std::string& path) {
  std::ifstream in(path);
  std::vector<double> numbers;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#")) numbers.push_back(std::strtod(line.c_str(), nullptr));
  }
  return numbers;
}

DryRun dry_run(const launcher::SystemLayout& plan, const report::ReportSources& sources) {
  DryRun run;
  run.report = report::make_report(sources);
  run.steps = report::steps_with_ticks(sources);
  run.period_s = plan.buses.tick_s();
  std::ifstream commands(plan.commands_file());
  std::size_t unread = 0;
  run.lives = report::command_lives(commands, unread);
  run.verify_us = numbers_in(plan.verify_times_file());
  return run;
}

bool publish(const Json& report, bool is_serial, const std::string& file) {
  if (file == "-") {
    std::puts(report.dump().c_str());
    return true;
  }
  std::fputs(check_text(report, is_serial).c_str(), stdout);
  return file.empty() || write_report(file, report);
}

}  // namespace

// The lianad of the dry run must not be found by those who look for the arm's: it has a runtime directory of its own.
int check_command(const launcher::RunOptions& given) {
  const Clock::time_point began = Clock::now();
  launcher::RunOptions options = given;
  options.is_dry_run = true;
  options.time = "fast";
  const launcher::SystemLayout plan = launcher::make_layout(options);
  setenv("XDG_RUNTIME_DIR", plan.socket_dir.c_str(), 1);
  launcher::RunSession session(plan);
  const launcher::RunResult end = session.run();
  DryRun run;
  if (!end.bad_input) run = dry_run(plan, report_sources(options, plan, session, end));
  launcher::discard(plan);
  if (end.bad_input) throw launcher::BadInput(end.message);
  if (!end.message.empty()) std::fprintf(stderr, "liana: %s\n", end.message.c_str());
  run.wall_time_s = std::chrono::duration<double>(Clock::now() - began).count();
  const Json report = check_report(run);
  const bool written = publish(report, plan.is_serial, options.report_file);
  return report["outcome"] == "success" && written ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
