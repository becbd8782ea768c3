// Where scripts lie: names and files, and what messages call them.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace liana::mission_runner {

// A script's text and its name in messages.
struct ScriptFile {
  std::string display;  // relative to the Lua folder, or as the user gave it
  std::string text;
  std::string folder{};    // where it lies
  bool is_beside = false;  // in the folder of the script that needs it, not in one of Liana's
};

// Folders in which scripts and modules are looked up by name, in turn.
struct LuaFolders {
  LuaFolders() = default;
  LuaFolders(std::vector<std::string> folders) : in_turn(std::move(folders)) {}
  LuaFolders(const char* folder) : in_turn{folder} {}

  std::vector<std::string> in_turn;
};

// The script called `name` of kind robot, scene, buses, drive or mission: a name in its folder, or a file (contains
// '/', ends in .lua, or in .json for a mission: a plan). Throws std::runtime_error when there is none, naming those
// there are.
ScriptFile find_script(const LuaFolders& lua_folders, const std::string& kind, const std::string& name);

// The first file of module `name` ("liana", "liana.geometry", "robots.zhu2022"): in the Lua folders, then in the folder
// `beside` of the script that is run (empty: none). Throws std::runtime_error saying where it looked.
ScriptFile find_module(const LuaFolders& lua_folders, const std::string& beside, const std::string& name);

// The file called `name` in the folder of a script, or below it; `what` is what messages call it. Throws
// std::runtime_error when it is not there, or lies elsewhere: by an absolute path, by .. or by a link.
ScriptFile find_beside(const std::string& folder, const std::string& name, const std::string& what);

}  // namespace liana::mission_runner
