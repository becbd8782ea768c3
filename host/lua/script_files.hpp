// Where scripts lie: names and files, and what messages call them.
#pragma once

#include <string>

namespace liana::script {

// A script's text and its name in messages.
struct ScriptFile {
  std::string display;  // relative to the Lua folder, or as the user gave it
  std::string text;
  std::string folder{};  // where it lies
};

// The script called `name` of kind robot, scene, buses or mission: a name in its folder, or a file (contains '/', ends
// in .lua, or in .json for a mission: a plan). Throws std::runtime_error when there is none, naming those there are.
ScriptFile find_script(const std::string& lua_dir, const std::string& kind, const std::string& name);

// The file of module `name` ("liana", "liana.geometry", "robots.zhu2022"): only letters, digits, '_' and '.', only
// below the Lua folder.
ScriptFile find_module(const std::string& lua_dir, const std::string& name);

}  // namespace liana::script
