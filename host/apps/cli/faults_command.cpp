#include <cstdio>

#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/apps/report/fault_table.hpp"
#include "host/base/json/json.hpp"
#include "host/control/verification/refusal_table.hpp"

namespace liana::cli {
namespace {

Json json_of(const std::vector<report::FaultRow>& rows) {
  Json list = Json::array();
  for (const report::FaultRow& row : rows) {
    list.push_back({{"number", static_cast<int>(row.info.number)},
                    {"name", row.info.name},
                    {"detected_by", row.detector},
                    {"within_ticks", row.within_ticks < 0 ? Json() : Json(row.within_ticks)},
                    {"stops_by", row.stops_by},
                    {"retract", row.info.retract},
                    {"text", row.info.text},
                    {"remedy", row.info.remedy}});
  }
  return list;
}

void print_text(const std::vector<report::FaultRow>& rows) {
  for (const report::FaultRow& row : rows) {
    std::printf("%d %s (%s%s): %s\n", static_cast<int>(row.info.number), row.info.name, row.stops_by.c_str(),
                row.info.retract ? ", retract possible" : "", row.info.text);
    std::printf("     detected by %s\n", row.detector);
    if (row.within_ticks >= 0) std::printf("     within ticks: %d\n", row.within_ticks);
    std::printf("     %s\n", row.info.remedy);
  }
}

Json json_of(std::span<const verification::RefusalRow> rows) {
  Json list = Json::array();
  for (const verification::RefusalRow& row : rows) {
    list.push_back({{"code", static_cast<int>(row.code)},
                    {"name", row.name},
                    {"text", row.says},
                    {"unit", row.unit},
                    {"action", verification::refusal_action_name(row.action)},
                    {"remedy", row.remedy}});
  }
  return list;
}

report::FaultTimes times_of(const std::string& robot) {
  const std::string text = launcher::evaluate_table("robot", robot);
  const launcher::TableText buses = launcher::buses_of(robot, text, "");
  return launcher::checked([&]() -> report::FaultTimes {
    const config::BusesConfig parsed = config::parse_buses(buses.json, buses.name);
    if (config::robot_kind(text, robot) == "serial") return {parsed.tick_s()};
    return {parsed.tick_s(), config::parse_robot(text, robot, "nominal", parsed).table.segment_count};
  });
}

void print_refusals(const FaultsOptions& options) {
  const std::span<const verification::RefusalRow> rows = verification::refusal_table();
  if (options.json) {
    std::puts(json_of(rows).dump(1).c_str());
  } else if (options.markdown) {
    std::fputs(verification::markdown_of(rows).c_str(), stdout);
  } else {
    for (const verification::RefusalRow& row : rows)
      std::printf("%d %s (%s): %s\n     %s\n", static_cast<int>(row.code), row.name,
                  verification::refusal_action_name(row.action), row.says, row.remedy);
  }
}

}  // namespace

int faults_command(const FaultsOptions& options) {
  if (options.json && options.markdown) throw launcher::BadInput("--json, --markdown: give one of them");
  if (options.refusals) {
    print_refusals(options);
    return launcher::kExitOk;
  }
  const std::vector<report::FaultRow> rows = report::fault_rows(times_of(options.robot));
  if (options.json) {
    std::puts(json_of(rows).dump(1).c_str());
  } else if (options.markdown) {
    std::fputs(report::markdown_of(rows).c_str(), stdout);
  } else {
    print_text(rows);
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
