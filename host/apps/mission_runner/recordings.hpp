// Recorded hands that a mission's steps name with `task`.
#pragma once

#include <string>
#include <vector>

#include "host/apps/mission_runner/script_files.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::mission_runner {

// Where `.hand` files are looked for, in turn: beside the mission, then in `recordings` of every Lua folder.
std::vector<std::string> recording_folders(const LuaFolders& lua_folders, const std::string& mission_folder);

// Throws std::runtime_error, naming the step and the folders, where a `vr` step of the description
// (lua/liana/check.lua) names a recording that is not there, or is none of VR handles.
void check_recordings(const Json& description, const std::vector<std::string>& folders);

}  // namespace liana::mission_runner
