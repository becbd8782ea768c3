#include "host/apps/mission_runner/evaluate.hpp"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "firmware_like/drive/drive_io.hpp"
#include "host/api/server/request_bounds.hpp"
#include "host/apps/mission_runner/bindings.hpp"
#include "host/apps/mission_runner/drive_tables.hpp"
#include "host/apps/mission_runner/json_bridge.hpp"
#include "host/apps/mission_runner/recordings.hpp"
#include "host/apps/mission_runner/scene_shapes.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/bench_buses.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/serial_robot.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::mission_runner {
namespace {

constexpr const char* kCurve = "curve";
constexpr const char* kCampaign = "campaign";
constexpr std::string_view kBench = "bench_";  // begin of the names of config::bench_buses
constexpr const char* kPlanAdvice = "give a file that liana plan --out has written";

// A file as Lua names it in messages: the end of a long name only.
std::string short_name(const std::string& display) {
  constexpr std::size_t kLongest = LUA_IDSIZE - 1;
  return display.size() <= kLongest ? display : "..." + display.substr(display.size() - (kLongest - 3));
}

// Messages begin with the whole name of the file.
template <typename Action>
void naming_file(const std::string& display, const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    const std::string text = error.what(), said = short_name(display);
    if (text.starts_with(said + ":")) throw std::runtime_error(display + text.substr(said.size()));
    throw std::runtime_error(display + ": " + text);
  }
}

int push_refusal_protected(lua_State* state) {
  push_refusal(state, *static_cast<const RobotAtHand*>(lua_touserdata(state, 1)));
  return 1;
}

std::optional<config::SerialRobotConfig> serial_arm(const Against& tables) {
  if (config::kind_of(tables.robot) != "serial") return std::nullopt;
  const std::string robot = tables.robot.dump(), name = tables.robot.value("name", "");
  if (tables.buses.is_object())
    return config::parse_serial_robot(robot, name, config::parse_buses(tables.buses.dump(), "buses"));
  config::SerialRobotConfig arm = config::parse_serial_robot(robot, name);
  arm.has_wrist_sensor = arm.has_adapter = true;  // for all that is known
  return arm;
}

// Replaces what is on the stack by what a function of liana.check makes of it.
void replace_by(Script& script, const char* function) {
  script.require("liana.check");
  lua_getfield(script.state(), -1, function);
  lua_replace(script.state(), -2);
  lua_insert(script.state(), -2);
  script.call(1, 1);
}

// What liana.check says of the mission on the stack (`describe`, `tables`).
Json told(Script& script, const char* function, const std::string& display) {
  lua_pushvalue(script.state(), -1);
  replace_by(script, function);
  Json description = to_json(script.state(), -1, display);
  lua_pop(script.state(), 1);
  return description;
}

bool is_plan(const ScriptFile& file) { return file.display.ends_with(".json"); }

// Leaves liana.plan_step.NAME(...) ready to be called.
void push_plan_function(Script& script, const char* name) {
  script.require("liana.plan_step");
  lua_getfield(script.state(), -1, name);
  lua_remove(script.state(), -2);
}

// A mission, or what one is made of, before a robot is known.
struct Loaded {
  struct Plan {
    std::string where;  // in messages
    Json content;
  };
  ScriptFile file;
  std::vector<Plan> plans;
  std::vector<ScriptFile> files;  // all that it is made of beside Liana's own
};

// The plan of one step of the mission on the stack; `step` is an entry of liana.plan_step.files.
void give_plan(Script& script, Loaded& loaded, const Json& step) {
  const std::string name = step.value("file", ""), where = step.value("where", "") + ": plan";
  const ScriptFile file = find_beside(loaded.file.folder, name, where);
  loaded.plans.push_back({where + ": " + name, config::parse_json(file.text, where + ": " + name, kPlanAdvice)});
  loaded.files.push_back(file);
  push_plan_function(script, "give");
  lua_pushvalue(script.state(), -2);
  lua_pushinteger(script.state(), step.value("step", 0));
  push_in_protection(script, loaded.plans.back().content);
  script.call(3, 0);
}

void push_mission_of_plan(Script& script, Loaded& loaded) {
  const std::string& name = loaded.file.display;
  loaded.plans.push_back({name, config::parse_json(loaded.file.text, name, kPlanAdvice)});
  push_plan_function(script, "mission");
  push_in_protection(script, loaded.plans.back().content);
  script.call(1, 1);
  loaded.files.push_back(loaded.file);
}

// Leaves the mission of a script on the stack, or of a plan that `liana plan --out` has written.
Loaded push_mission(Script& script, const ScriptFile& file) {
  Loaded loaded{file, {}, {}};
  if (is_plan(file)) {
    push_mission_of_plan(script, loaded);
    return loaded;
  }
  script.run(file);
  replace_by(script, "opened");  // refuses what is no mission
  push_plan_function(script, "files");
  lua_pushvalue(script.state(), -2);
  script.call(1, 1);
  const Json steps = to_json(script.state(), -1, file.display);
  lua_pop(script.state(), 1);
  for (const Json& step : steps) give_plan(script, loaded, step);
  loaded.files.insert(loaded.files.begin(), script.files().begin(), script.files().end());
  return loaded;
}

// A plan is a way of the robot that it was made for, and of no other.
void check_robot_of_plan(const Loaded::Plan& plan, const Json& robot) {
  const Json& planned = plan.content.member_or_null("inputs").member_or_null("robot");
  if (planned == robot) return;
  const std::string name = robot.value("name", ""),
                    other = planned.is_object() ? planned.value("name", "") : std::string();
  const std::string which =
      other.empty() || other == name ? "other tables of robot " + name : "robot " + other + ", not for " + name;
  throw std::runtime_error(plan.where + ": inputs.robot: made for " + which +
                           ": allowed the robot that runs: name that of the plan with --robot, or plan again");
}

// Name, place and SHA-256 of every file that a mission is made of.
Json described_files(const Loaded& loaded) {
  Json files = Json::array();
  for (const ScriptFile& file : loaded.files) {
    const std::string name = std::filesystem::path(file.display).filename().string();
    files.push_back({{"file", file.is_beside ? file.display : name},
                     {"path", std::filesystem::absolute(std::filesystem::path(file.folder) / name).string()},
                     {"sha256", config::sha256_hex(file.text)}});
  }
  return files;
}

// Of bench_7: 7. Empty for every other name.
std::optional<std::int32_t> drives_of_bench(const std::string& name) {
  std::int32_t drives = 0;
  if (!name.starts_with(kBench)) return std::nullopt;
  const char* end = name.data() + name.size();
  const auto [stopped, error] = std::from_chars(name.data() + kBench.size(), end, drives);
  if (error != std::errc() || stopped != end || drives < 1 || drives > kMaxDrives) return std::nullopt;
  return drives;
}

}  // namespace

void check_against_robot(Script& script, const Against& against, Looks looks) {
  lua_State* state = script.state();
  RobotAtHand robot{api::request_bounds(against.robot), serial_arm(against)};
  script.require("liana.preflight_robot");
  lua_pushvalue(state, -2);
  push_in_protection(script, against.robot);
  lua_pushcfunction(state, push_refusal_protected);
  lua_pushlightuserdata(state, &robot);
  script.call(1, 1);
  if (looks == Looks::kIntoFunctions) {
    lua_pushcfunction(state, attempt);
  } else {
    lua_pushnil(state);
  }
  script.call(4, 0);
}

void load_mission(Script& script, const LuaFolders& lua_folders, const std::string& name) {
  const ScriptFile file = find_script(lua_folders, "mission", name);
  naming_file(file.display, [&] {
    push_mission(script, file);
    check_recordings(told(script, "describe", file.display), recording_folders(lua_folders, file.folder));
  });
}

std::string evaluate(Script& script, const LuaFolders& lua_folders, const std::string& kind, const std::string& name) {
  if (const auto drives = drives_of_bench(name); drives && kind == "buses") return config::bench_buses(*drives);
  const ScriptFile file = find_script(lua_folders, kind, name);
  Json result;
  naming_file(file.display, [&] {
    script.run(file);
    result = to_json(script.state(), -1, file.display);
    if (kind == "scene") read_shape_files(result, file.folder, file.display);
    if (kind == "buses") add_drive_types(script, lua_folders, result, file.display);
  });
  if (kind == kCurve) return config::canonical_json(result);  // who follows it checks it
  const std::string checked = config::check_table(kind, result, file.display);
  if (kind != kCampaign) return checked;
  result["folder"] = std::filesystem::absolute(file.folder).lexically_normal().string();  // of files that it names
  return config::canonical_json(result);
}

std::string evaluate_mission_tables(Script& script, const LuaFolders& lua_folders, const std::string& name) {
  const ScriptFile file = find_script(lua_folders, "mission", name);
  Json result;
  naming_file(file.display, [&] {
    push_mission(script, file);
    result = told(script, "tables", file.display);
  });
  return config::canonical_json(result);
}

std::string evaluate_mission(Script& script, const LuaFolders& lua_folders, const std::string& name,
                             const Against& against) {
  const ScriptFile file = find_script(lua_folders, "mission", name);
  Json result;
  naming_file(file.display, [&] {
    const Loaded loaded = push_mission(script, file);
    for (const Loaded::Plan& plan : loaded.plans) check_robot_of_plan(plan, against.robot);
    check_against_robot(script, against, Looks::kIntoFunctions);
    result = told(script, "describe", file.display);
    const std::vector<std::string> folders = recording_folders(lua_folders, file.folder);
    check_recordings(result, folders);
    result["recordings"] = folders;
    result["files"] = described_files(loaded);
  });
  return config::canonical_json(result);
}

}  // namespace liana::mission_runner
