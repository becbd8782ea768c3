// liana-mission: evaluates Lua tables and runs missions, each in a process that a watchdog can kill.
#include <cstdio>
#include <exception>
#include <functional>

#include "host/api/server/request_pages.hpp"
#include "host/apps/mission_runner/bindings.hpp"
#include "host/apps/mission_runner/evaluate.hpp"
#include "host/apps/mission_runner/mission_run.hpp"
#include "host/apps/mission_runner/watchdog.hpp"
#include "host/base/install_paths/places.hpp"
#include "host/base/json/json.hpp"
#include "host/base/options/command_line.hpp"
#include "host/base/text/text_output.hpp"
#include "host/model/config/field.hpp"

using namespace liana::mission_runner;

namespace {

constexpr const char* kMissionTables = "mission_tables";
constexpr const char* kDefaultRobot = "zhu2022";
constexpr const char* kLuaDirAbout = "a folder of tables and missions that is searched first (docs/how-to/install.md)";

// Runs `body`; bad input becomes one message on standard error and exit code 2.
int with_message(const std::function<int()>& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "liana-mission: %s\n", error.what());
    return kExitBadInput;
  }
}

struct EvalOptions {
  LuaFolders lua_folders;
  std::string kind, name, robot, bus;
};

std::string tables_of_mission(const EvalOptions& options, Activity& activity) {
  Script script(ScriptLimits{}, options.lua_folders, activity);
  return evaluate_mission_tables(script, options.lua_folders, options.name);
}

liana::Json table(const EvalOptions& options, Activity& activity, const std::string& kind, const std::string& name) {
  if (name.ends_with(".json")) return liana::Json::parse(liana::config::read_text_file(name));
  Script script(ScriptLimits{}, options.lua_folders, activity);
  return liana::Json::parse(evaluate(script, options.lua_folders, kind, name));
}

// What is named, else what the mission names itself: its buses beside its own robot only.
Against tables_against(const EvalOptions& options, Activity& activity) {
  std::string robot = options.robot, bus = options.bus;
  if (robot.empty() || bus.empty()) {
    const liana::Json own = liana::Json::parse(tables_of_mission(options, activity));
    if (robot.empty()) robot = own.value("robot", kDefaultRobot);
    if (bus.empty() && robot == own.value("robot", "")) bus = own.value("bus", "");
  }
  return {table(options, activity, "robot", robot),
          bus.empty() ? liana::Json() : table(options, activity, "buses", bus)};
}

std::string evaluated(const EvalOptions& options, Activity& activity) {
  if (options.kind == kMissionTables) return tables_of_mission(options, activity);
  const Against against = options.kind == "mission" ? tables_against(options, activity) : Against{};
  Script script(ScriptLimits{}, options.lua_folders, activity);
  return options.kind == "mission" ? evaluate_mission(script, options.lua_folders, options.name, against)
                                   : evaluate(script, options.lua_folders, options.kind, options.name);
}

int evaluate_and_print(const EvalOptions& options, Activity& activity) {
  std::printf("%s\n", evaluated(options, activity).c_str());
  return 0;
}

// What the watchdog's kill means for the user, in one message.
std::string killed_text(const std::string& name, const Activity& activity) {
  return name + ": computed for more than 2 s without giving back control and was killed, last seen at " +
         last_seen(activity) + ": look for an endless loop";
}

int eval_command(const EvalOptions& options) {
  const std::string& name = options.name;
  Activity& activity = shared_activity();
  const WatchedEnd end =
      run_watched(activity, {}, [&] { return with_message([&] { return evaluate_and_print(options, activity); }); });
  if (end.killed_by_watchdog) std::fprintf(stderr, "liana-mission: %s\n", killed_text(name, activity).c_str());
  if (end.signal != 0)
    std::fprintf(stderr, "liana-mission: %s: the script's process was killed by signal %d\n", name.c_str(), end.signal);
  return end.killed_by_watchdog ? kExitBadInput : end.exit_code;
}

// Reports for a script's process that can no longer do it.
int report_death(const MissionOptions& options, const Activity& activity, const std::string& reason) {
  std::fprintf(stderr, "liana-mission: %s\n", reason.c_str());
  if (!options.report_file.empty()) write_report(options.report_file, failed_report(activity, options.mission, reason));
  return kExitNotSuccess;
}

int run_command(const MissionOptions& options) {
  Activity& activity = shared_activity();
  const WatchedEnd end =
      run_watched(activity, {}, [&] { return with_message([&] { return run_mission(options, activity); }); });
  if (end.killed_by_watchdog)
    return report_death(options, activity, killed_text(options.mission, activity) + "; the arm holds");
  if (end.signal != 0) {
    return report_death(
        options, activity,
        options.mission + ": its process was killed by signal " + std::to_string(end.signal) + "; the arm holds");
  }
  return end.exit_code;
}

int bindings_command() {
  liana::Json list = liana::Json::array();
  for (const liana::api::RequestRow* row : commands()) {
    liana::Json fields = liana::Json::array();
    for (const liana::api::RequestField& field : row->fields) {
      const bool required = field.need == liana::api::Need::kRequired;
      fields.push_back(
          {{"name", field.name}, {"type", liana::api::lua_type(field)}, {"required", required}, {"doc", field.doc}});
    }
    list.push_back({{"name", row->op}, {"doc", row->doc}, {"fields", fields}});
  }
  std::printf("%s\n", list.dump().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  liana::text::print_only_text();
  liana::options::CommandLine line("Evaluates Liana's Lua tables and runs missions");
  MissionOptions options;
  std::string lua_dir;
  EvalOptions evaluated;
  liana::options::Command eval = line.command("eval", "check a table and print it as canonical JSON");
  eval.option("kind", evaluated.kind, "robot, scene, buses, drive, budget, curve, mission or mission_tables")
      .required();
  eval.option("name", evaluated.name, "a name in the Lua folder or a file").required();
  eval.option("--robot", evaluated.robot,
              "robot a mission is checked against: a name or exported JSON; where not given its own, else zhu2022");
  eval.option("--bus", evaluated.bus,
              "buses a mission is checked against: as --robot; where not given those that it names with its robot");
  eval.option("--lua-dir", lua_dir, kLuaDirAbout);
  liana::options::Command run = line.command(
      "run", "run a mission; exit 0 on success, 1 when not or when its process was killed, 2 for bad input");
  run.option("--api", options.api, "socket of lianad").required();
  run.option("--mission", options.mission, "a name in lua/missions or a file").required();
  run.option("--lua-dir", lua_dir, kLuaDirAbout);
  run.option("--report", options.report_file, "file for the report (JSON)");
  run.flag("--lockstep", options.lockstep, "let virtual time wait for this mission");
  run.flag("--rehearsal", options.rehearsal,
           "nobody is there: steps are confirmed at once, and a mission that would wait for people ends");
  run.flag("--progress", options.progress, "print a line when a step begins and ends");
  run.flag("--json", options.json, "print progress and report as JSON lines");
  liana::options::Command list = line.command("bindings", "print the commands a mission can give, as JSON");
  if (const auto code = line.parse(argc, argv)) return *code == 0 ? 0 : kExitBadInput;
  return with_message([&] {
    if (!lua_dir.empty()) liana::install_paths::search_first("--lua-dir", lua_dir);
    evaluated.lua_folders = options.lua_folders = liana::install_paths::lua_folders();
    if (eval.chosen()) return eval_command(evaluated);
    return list.chosen() ? bindings_command() : run_command(options);
  });
}
