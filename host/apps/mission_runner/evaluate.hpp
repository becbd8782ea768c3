// Tables and missions from Lua files, without running anything on the arm.
#pragma once

#include <cstdint>
#include <string>

#include "host/apps/mission_runner/script.hpp"
#include "host/base/json/json.hpp"

namespace liana::mission_runner {

// Canonical JSON of a robot, scene or buses table, or of a curve, whose content is not checked. Throws
// std::runtime_error with one message.
std::string evaluate(Script& script, const LuaFolders& lua_folders, const std::string& kind, const std::string& name);

// Canonical JSON of the tables that a mission says it runs with: `robot`, `scene`, `bus`, each where it says one.
// Throws as evaluate does.
std::string evaluate_mission_tables(Script& script, const LuaFolders& lua_folders, const std::string& name);

// Tables that a mission is checked against, as canonical JSON. Of `buses` that are null nothing is known, and nothing
// that they may lack is refused.
struct Against {
  Json robot, buses;
};

// Canonical JSON of a mission's structure, after a check that the robot can do it. Throws as evaluate does.
std::string evaluate_mission(Script& script, const LuaFolders& lua_folders, const std::string& name,
                             const Against& against);

// Runs a mission file and leaves the checked mission on the stack. Throws as evaluate does.
void load_mission(Script& script, const LuaFolders& lua_folders, const std::string& name);

// How far a check goes: into what is written as a value only, or also into the functions of steps, which are called
// once for that and may change what the script remembers: in a script that runs nothing afterwards.
enum class Looks : std::uint8_t { kAtValues, kIntoFunctions };

// Refuses the checked mission on the stack, which stays there, when the robot cannot do it. Throws as evaluate does.
void check_against_robot(Script& script, const Against& against, Looks looks);

}  // namespace liana::mission_runner
