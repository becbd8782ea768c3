#include "host/apps/mission_runner/drive_tables.hpp"

#include <stdexcept>

#include "host/apps/mission_runner/json_bridge.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"

namespace liana::mission_runner {
namespace {

ScriptFile file_of(const LuaFolders& lua_folders, const config::Field& name) {
  const std::string type = name.name(40);
  try {
    return find_script(lua_folders, "drive", type);
  } catch (const std::runtime_error& error) {
    // Its words for a type that is not there offer a file, which a bus table cannot name.
    std::string text = error.what();
    if (const std::size_t file = text.rfind(" or a file"); file != text.npos)
      text.replace(file, std::string::npos,
                   ", or put your own into drives/" + type + ".lua below a folder of --lua-dir");
    throw std::runtime_error(name.file() + ": " + text);
  }
}

void add_type(Script& script, const LuaFolders& lua_folders, const config::Field& name, Json& types) {
  const ScriptFile file = file_of(lua_folders, name);
  script.run(file);
  const Json type = to_json(script.state(), -1, file.display);
  config::check_table("drive", type, file.display);
  types[name.json().text()] = type;
}

}  // namespace

void add_drive_types(Script& script, const LuaFolders& lua_folders, Json& buses, const std::string& display) {
  if (!buses.is_object() || !buses.contains("drives") || buses.contains("drive_types")) return;
  const Json table = buses;
  const config::Field list = config::Field(table, display, "").at("drives");
  const std::size_t count = list.size(0, cable::kMaxCables, "one entry for each type");
  Json types = Json::object();
  for (std::size_t i = 0; i < count; ++i) {
    const config::Field entry = list.element(i);
    add_type(script, lua_folders, entry.at("type"), types);
    if (entry.json().contains("bench")) add_type(script, lua_folders, entry.at("bench"), types);
  }
  buses["drive_types"] = types;
}

}  // namespace liana::mission_runner
