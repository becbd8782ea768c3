#include "host/lua/evaluate.hpp"

#include <stdexcept>

#include "host/api/request_bounds.hpp"
#include "host/config/canonical.hpp"
#include "host/config/config.hpp"
#include "host/config/field.hpp"
#include "host/json/json.hpp"
#include "host/lua/bindings.hpp"
#include "host/lua/json_bridge.hpp"
#include "host/lua/scene_shapes.hpp"

namespace liana::script {
namespace {

constexpr const char* kPlanAdvice = "give a file that liana plan --out has written";

// Adds the file to messages that do not begin with it, such as those of the mission checker.
template <typename Action>
void naming_file(const std::string& display, const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    if (text.starts_with(display + ":")) throw;
    throw std::runtime_error(display + ": " + text);
  }
}

int push_refusal_protected(lua_State* state) {
  push_refusal(state, *static_cast<const api::RequestBounds*>(lua_touserdata(state, 1)));
  return 1;
}

// Replaces the mission on the stack by its description; refuses anything that is no mission.
Json describe(Script& script, const std::string& display) {
  script.require("liana.check");
  lua_getfield(script.state(), -1, "describe");
  lua_pushvalue(script.state(), -3);
  script.call(1, 1);
  Json description = to_json(script.state(), -1, display);
  lua_pop(script.state(), 2);
  return description;
}

// Leaves the mission of a script on the stack, or of a plan that `liana plan --out` has written.
void push_mission(Script& script, const ScriptFile& file) {
  if (!file.display.ends_with(".json")) return script.run(file);
  const Json plan = config::parse_json(file.text, file.display, kPlanAdvice);
  script.require("liana.plan_mission");
  push_in_protection(script, plan);
  script.call(1, 1);
}

// A plan is a way of the robot that it was made for, and of no other.
void check_robot_of_plan(const ScriptFile& file, const Json& robot) {
  if (!file.display.ends_with(".json")) return;
  const Json plan = config::parse_json(file.text, file.display, kPlanAdvice);
  if (plan.member_or_null("inputs").member_or_null("robot") == robot) return;
  throw std::runtime_error(
      "inputs.robot: another robot than " + robot.value("name", "") +
      ", or other tables of it: allowed the same: " + "name the robot with --robot, or plan again");
}

}  // namespace

void check_against_robot(Script& script, const Json& robot) {
  lua_State* state = script.state();
  api::RequestBounds bounds = api::request_bounds(robot);
  script.require("liana.check");
  lua_getfield(state, -1, "against");
  lua_pushvalue(state, -3);
  push_in_protection(script, robot);
  lua_pushcfunction(state, push_refusal_protected);
  lua_pushlightuserdata(state, &bounds);
  script.call(1, 1);
  script.call(3, 0);
  lua_pop(state, 1);
}

void load_mission(Script& script, const LuaFolders& lua_folders, const std::string& name) {
  const ScriptFile file = find_script(lua_folders, "mission", name);
  naming_file(file.display, [&] {
    push_mission(script, file);
    describe(script, file.display);
  });
}

std::string evaluate(Script& script, const LuaFolders& lua_folders, const std::string& kind, const std::string& name) {
  const ScriptFile file = find_script(lua_folders, kind, name);
  Json result;
  naming_file(file.display, [&] {
    script.run(file);
    result = to_json(script.state(), -1, file.display);
    if (kind == "scene") read_shape_files(result, file.folder, file.display);
  });
  return config::check_table(kind, result, file.display);
}

std::string evaluate_mission(Script& script, const LuaFolders& lua_folders, const std::string& name,
                             const std::string& robot_json) {
  const ScriptFile file = find_script(lua_folders, "mission", name);
  Json result;
  naming_file(file.display, [&] {
    const Json robot = Json::parse(robot_json);
    push_mission(script, file);
    check_robot_of_plan(file, robot);
    check_against_robot(script, robot);
    result = describe(script, file.display);
  });
  return config::canonical_json(result);
}

}  // namespace liana::script
