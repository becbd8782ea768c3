// Drive types that a bus table names.
#pragma once

#include <string>

#include "host/apps/mission_runner/script.hpp"
#include "host/apps/mission_runner/script_files.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::mission_runner {

// Puts every table of lua/drives that `drives[].type` and `drives[].bench` name into `drive_types` of the bus table, so
// that its JSON says all that a boot needs; fields are left to host/model/config. Throws std::runtime_error "file:
// field:
// ..." for a name that there is not.
void add_drive_types(Script& script, const LuaFolders& lua_folders, Json& buses, const std::string& display);

}  // namespace liana::mission_runner
