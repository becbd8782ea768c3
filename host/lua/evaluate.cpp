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
    result = kind == "mission" ? describe(script, file.display) : to_json(script.state(), -1, file.display);
  });
  return kind == "mission" ? canonical_json(result) : check_table(kind, result, file.display);
}

}  // namespace liana
