// Tables and missions from Lua files, without running anything on the arm.
#pragma once

#include <string>

#include "host/lua/script.hpp"

namespace liana {

// Canonical JSON of a robot, scene or buses table, or of a mission's structure. Throws std::runtime_error with one message.
std::string evaluate(Script& script, const std::string& lua_dir, const std::string& kind, const std::string& name);

// Runs a mission file and leaves the checked mission on the stack. Throws as evaluate does.
void load_mission(Script& script, const std::string& lua_dir, const std::string& name);

}  // namespace liana
