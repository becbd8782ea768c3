#include "host/lua/script_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

namespace liana::script {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestScript = 1 << 20;
const std::map<std::string, std::string> kFolders = {
    {"robot", "robots"}, {"scene", "scenes"}, {"buses", "buses"}, {"mission", "missions"}};

ScriptFile read_script(const fs::path& path, const std::string& display) {
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    throw std::runtime_error(display + ": no such file: allowed a Lua file: check the path");
  if (fs::file_size(path, error) > kLargestScript)
    throw std::runtime_error(display + ": too large: allowed 1 MiB: split it into modules");
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error(display + ": cannot be read: allowed a readable Lua file: check its permissions");
  return {display, std::move(text), path.has_parent_path() ? path.parent_path().string() : "."};
}

std::string names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".lua") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "nothing in " + folder.string() : text;
}

}  // namespace

ScriptFile find_script(const std::string& lua_dir, const std::string& kind, const std::string& name) {
  const auto folder = kFolders.find(kind);
  if (folder == kFolders.end())
    throw std::runtime_error("kind: " + kind + ": allowed robot, scene, buses, mission: use one of these words");
  const bool is_file =
      name.find('/') != std::string::npos || name.ends_with(".lua") || (kind == "mission" && name.ends_with(".json"));
  if (is_file) return read_script(name, name);
  const fs::path path = fs::path(lua_dir) / folder->second / (name + ".lua");
  if (!fs::exists(path)) {
    throw std::runtime_error(kind + ": " + name + ": allowed " + names_in(path.parent_path()) +
                             ": give one of these names or a file");
  }
  return read_script(path, folder->second + "/" + name + ".lua");
}

ScriptFile find_module(const std::string& lua_dir, const std::string& name) {
  const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.'; };
  if (name.empty() || name.size() > 80 || name.front() == '.' || name.find("..") != std::string::npos ||
      !std::all_of(name.begin(), name.end(), allowed)) {
    throw std::runtime_error("require: " + name +
                             ": allowed modules of the Lua folder, such as liana or liana.geometry: correct the name");
  }
  std::string relative = name;
  std::replace(relative.begin(), relative.end(), '.', '/');
  if (fs::is_directory(fs::path(lua_dir) / relative)) relative += "/init";
  return read_script(fs::path(lua_dir) / (relative + ".lua"), relative + ".lua");
}

}  // namespace liana::script
