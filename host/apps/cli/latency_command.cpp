#include <array>
#include <cstdio>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/latency_session.hpp"
#include "host/apps/launcher/start_pose.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/apps/report/latency_report.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

// The shipped robot's embedded tables by rate: which rate a table can carry is a matter of its buses.
struct RateTable {
  const char* rate_hz;
  const char* name;
};
constexpr std::array<RateTable, 2> kTables{{{"250", "embedded"}, {"500", "embedded_500"}}};

std::string table_of(const LatencyOptions& options) {
  if (!options.buses.empty() || !options.robot.empty()) return options.buses;
  if (options.rate_hz.empty()) return kTables.front().name;
  for (const RateTable& table : kTables) {
    if (parse_number("--rate", options.rate_hz) == parse_number("--rate", table.rate_hz)) return table.name;
  }
  throw launcher::BadInput(
      "--rate: " + options.rate_hz +
      " Hz: allowed 250 (buses embedded) or 500 (buses embedded_500); for another rate name a table that "
      "carries it with --buses");
}

void check_rate(const LatencyOptions& options, const config::BusesConfig& buses) {
  if (options.rate_hz.empty() || parse_number("--rate", options.rate_hz) == buses.rate_hz) return;
  char rate[32];
  std::snprintf(rate, sizeof rate, "%g Hz", buses.rate_hz);
  throw launcher::BadInput("--rate: " + options.rate_hz + " Hz: bus table " + buses.name + " has " + rate +
                           "; leave --rate out or take another table");
}

void check_arm(const LatencyOptions& options) {
  if (options.arm != "full" && !options.robot.empty() && launcher::serial_robot_for_kinematics(options.robot))
    throw launcher::BadInput("--arm: '" + options.arm + "': robot " + options.robot +
                             " has a serial arm: its bench knows full only; leave it out");
}

report::LatencyMeasurement measured(const launcher::SystemLayout& plan, double seconds) {
  launcher::LatencySession session(plan);
  return session.measure(seconds);
}

}  // namespace

int latency_command(const LatencyOptions& options) {
  check_arm(options);
  launcher::RunOptions run;
  run.robot = options.robot;
  run.bus = table_of(options);
  run.time = "real";
  run.arm = options.arm;
  run.fixture = launcher::bent_pose(options.robot);
  if (options.arm == "light") run.physics = "ideal";
  const launcher::SystemLayout plan = launcher::for_latency(launcher::make_layout(run));
  try {
    check_rate(options, plan.buses);
    Json report = report::latency_report(measured(plan, options.seconds), plan.buses, options.seconds,
                                         report::examine_realtime());
    report["arm"] = options.arm;
    launcher::clean_up(plan, true);
    std::fputs((options.json ? report.dump() + "\n" : report::latency_text(report)).c_str(), stdout);
    return report.value("overruns", 1) == 0 && report.value("enabled", false) ? launcher::kExitOk
                                                                              : launcher::kExitFailure;
  } catch (...) {
    launcher::clean_up(plan, true);
    throw;
  }
}

}  // namespace liana::cli
