#include "host/lua/evaluate.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/config/canonical.hpp"
#include "host/config/config.hpp"
#include "host/lua/json_bridge.hpp"

namespace liana {
namespace {

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

// Refuses the mission on the stack, which stays there, when the robot cannot do it.
void check_against_robot(Script& script, const nlohmann::json& robot) {
  lua_State* state = script.state();
  script.require("liana.check");
  lua_getfield(state, -1, "against");
  lua_pushvalue(state, -3);
  push_in_protection(script, robot);
  script.call(2, 0);
  lua_pop(state, 1);
}

// Replaces the mission on the stack by its description; refuses anything that is no mission.
nlohmann::json describe(Script& script, const std::string& display) {
  script.require("liana.check");
  lua_getfield(script.state(), -1, "describe");
  lua_pushvalue(script.state(), -3);
  script.call(1, 1);
  nlohmann::json description = to_json(script.state(), -1, display);
  lua_pop(script.state(), 2);
  return description;
}

}  // namespace

void load_mission(Script& script, const std::string& lua_dir, const std::string& name) {
  const ScriptFile file = find_script(lua_dir, "mission", name);
  naming_file(file.display, [&] {
    script.run(file);
    describe(script, file.display);
  });
}

std::string evaluate(Script& script, const std::string& lua_dir, const std::string& kind, const std::string& name) {
  const ScriptFile file = find_script(lua_dir, kind, name);
  nlohmann::json result;
  naming_file(file.display, [&] {
    script.run(file);
    result = to_json(script.state(), -1, file.display);
  });
  return check_table(kind, result, file.display);
}

std::string evaluate_mission(Script& script, const std::string& lua_dir, const std::string& name, const std::string& robot_json) {
  const ScriptFile file = find_script(lua_dir, "mission", name);
  nlohmann::json result;
  naming_file(file.display, [&] {
    script.run(file);
    check_against_robot(script, nlohmann::json::parse(robot_json));
    result = describe(script, file.display);
  });
  return canonical_json(result);
}

}  // namespace liana
