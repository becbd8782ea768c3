#include "host/apps/mission_runner/script_files.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "host/base/file/in_file.hpp"

namespace liana::mission_runner {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestScript = 1 << 20;
const std::map<std::string, std::string> kFolders = {
    {"robot", "robots"},   {"scene", "scenes"},     {"buses", "buses"},  {"drive", "drives"},
    {"budget", "budgets"}, {"mission", "missions"}, {"curve", "curves"}, {"campaign", "campaigns"}};

ScriptFile read_script(const fs::path& path, const std::string& display) {
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    throw std::runtime_error(display + (fs::exists(path, error) ? ": no ordinary file" : ": no such file") +
                             ": allowed a Lua file: check the path");
  if (fs::file_size(path, error) > kLargestScript)
    throw std::runtime_error(display + ": too large: allowed 1 MiB: split it into modules");
  auto text = file::content_of(path);
  if (!text) throw std::runtime_error(display + ": cannot be read: allowed a readable Lua file: check its permissions");
  return {display, std::move(*text), path.has_parent_path() ? path.parent_path().string() : ".", false};
}

// The names of all scripts of a kind, in alphabetical order.
std::string names_of(const LuaFolders& lua_folders, const std::string& kind_folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const fs::path folder : lua_folders.in_turn) {
    for (const auto& entry : fs::directory_iterator(folder / kind_folder, error)) {
      if (entry.path().extension() == ".lua") names.insert(entry.path().stem().string());
    }
  }
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "nothing in " + kind_folder + " of " + lua_folders.in_turn.back() : text;
}

std::string list_of(const LuaFolders& lua_folders) {
  std::string text;
  for (const std::string& folder : lua_folders.in_turn) text += (text.empty() ? "" : ", ") + folder;
  return text;
}

// The first of `names` below a Lua folder that is a file; empty when there is none.
std::optional<fs::path> first_file(const LuaFolders& lua_folders, const std::vector<std::string>& names) {
  std::error_code error;
  for (const fs::path folder : lua_folders.in_turn) {
    for (const std::string& name : names) {
      if (fs::is_regular_file(folder / name, error)) return folder / name;
    }
  }
  return std::nullopt;
}

}  // namespace

ScriptFile find_script(const LuaFolders& lua_folders, const std::string& kind, const std::string& name) {
  const auto folder = kFolders.find(kind);
  if (folder == kFolders.end())
    throw std::runtime_error("kind: " + kind +
                             ": allowed robot, scene, buses, drive, budget, campaign, curve, mission, mission_tables: "
                             "use one of these words");
  const bool is_file =
      name.find('/') != std::string::npos || name.ends_with(".lua") || (kind == "mission" && name.ends_with(".json"));
  if (is_file) return read_script(name, name);
  const std::string display = folder->second + "/" + name + ".lua";
  const std::optional<fs::path> path = first_file(lua_folders, {display});
  if (!path) {
    throw std::runtime_error(kind + ": " + name + ": allowed " + names_of(lua_folders, folder->second) +
                             ": give one of these names or a file");
  }
  return read_script(*path, display);
}

ScriptFile find_beside(const std::string& folder, const std::string& name, const std::string& what) {
  std::error_code error;
  const fs::path home = fs::canonical(folder, error), path = fs::weakly_canonical(home / name, error);
  const auto [end, in_path] = std::mismatch(home.begin(), home.end(), path.begin(), path.end());
  if (error || end != home.end())
    throw std::runtime_error(what + ": " + name + ": leads out of " + home.string() +
                             ": allowed files in the folder of the script: put it there");
  if (!fs::is_regular_file(path, error))
    throw std::runtime_error(what + ": " + name + ": no such file in " + home.string() +
                             ": allowed files in the folder of the script: put it there, or correct the name");
  ScriptFile file = read_script(path, name);
  file.is_beside = true;
  return file;
}

ScriptFile find_module(const LuaFolders& lua_folders, const std::string& beside, const std::string& name) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  if (name.empty() || name.size() > 80 || name.front() == '.' || name.find("..") != std::string::npos ||
      !std::all_of(name.begin(), name.end(), allowed)) {
    throw std::runtime_error("require: " + name +
                             ": allowed modules of the Lua folder, such as liana or liana.geometry, and " +
                             "of the script's own folder, such as helpers or parts.helpers: correct the name");
  }
  std::string relative = name;
  std::replace(relative.begin(), relative.end(), '.', '/');
  const std::string file = relative + ".lua", init = relative + "/init.lua";
  const std::optional<fs::path> path = first_file(lua_folders, {init, file});
  const bool is_init = path && path->filename() == "init.lua" && !name.ends_with("init");
  if (path) return read_script(*path, is_init ? init : file);
  if (beside.empty())
    throw std::runtime_error("require: " + name + ": no such module: allowed modules of " + list_of(lua_folders) +
                             ": correct the name");
  try {
    std::error_code error;
    return find_beside(beside, fs::exists(fs::path(beside) / init, error) ? init : file, "require");
  } catch (const std::runtime_error& problem) {
    throw std::runtime_error(std::string(problem.what()) + " (looked in " + list_of(lua_folders) + " before)");
  }
}

}  // namespace liana::mission_runner
