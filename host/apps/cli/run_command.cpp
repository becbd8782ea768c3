#include <cstdio>
#include <filesystem>
#include <memory>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/run_page.hpp"
#include "host/apps/cli/session_report.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/gateway_process.hpp"
#include "host/apps/launcher/run_session.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/apps/report/run_report.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

bool publish_report(const launcher::RunOptions& options, const launcher::SystemLayout& plan, const Json& report) {
  bool written = write_report(plan.file("report.json"), report);
  if (options.report_file == "-") {
    std::puts(report.dump().c_str());
    return written;
  }
  if (!options.report_file.empty()) written = write_report(options.report_file, report) && written;
  std::fputs(report::report_text(report).c_str(), stdout);
  return written;
}

// Without lianad there are logs only.
std::string where_to_look(const launcher::SystemLayout& plan) {
  if (!std::filesystem::exists(plan.events_file())) return "its logs are kept in " + plan.directory;
  return "what happened and why is in " + plan.events_file() + ", its logs are beside it";
}

// A mission is not kept from running by a console that cannot.
std::unique_ptr<launcher::GatewayProcess> console_of(const launcher::SystemLayout& plan) {
  try {
    auto gateway = std::make_unique<launcher::GatewayProcess>(plan.api_socket(), launcher::GatewayOptions(),
                                                              plan.file("liana-gateway.log"));
    std::fprintf(stderr, "console: %s\n", gateway->address().c_str());
    return gateway;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana: no console: %s\n", error.what());
    return nullptr;
  }
}

}  // namespace

int run_command(const launcher::RunOptions& options) {
  const launcher::SystemLayout plan = launcher::make_layout(options);
  launcher::RunSession session(plan);
  std::unique_ptr<launcher::GatewayProcess> console;
  if (options.has_console) console = console_of(plan);
  const launcher::RunResult end = session.run();
  if (end.bad_input) {
    launcher::discard(plan);
    throw launcher::BadInput(end.message);
  }
  const Json report = report::make_report(report_sources(options, plan, session, end));
  const bool written = publish_report(options, plan, report);
  const bool success = report.value("outcome", "") == "success";
  if (!end.message.empty()) std::fprintf(stderr, "liana: %s\n", end.message.c_str());
  if (!success) {
    std::fprintf(stderr, "liana: the run did not succeed; %s\n", where_to_look(plan).c_str());
  }
  const bool stays = plan.directory != plan.socket_dir || !success;
  if (stays) leave_page(plan.directory, options.report_file == "-" ? stderr : stdout);
  launcher::clean_up(plan, success);
  return success && written ? launcher::kExitOk : launcher::kExitFailure;
}

}  // namespace liana::cli
