#include "host/base/install_paths/places.hpp"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace liana::install_paths {
namespace {

namespace fs = std::filesystem;

fs::path installed_folder() { return fs::path(program_folder()).parent_path() / "share" / "liana"; }

// A build folder has no share/liana: its programs use the tree that they were built of.
fs::path file_of(const char* installed, const char* in_source) {
  return is_installed() ? installed_folder() / installed : fs::path(in_source);
}

std::string checked_folder(const std::string& source, const std::string& folder) {
  std::error_code unreadable;
  if (fs::is_directory(folder, unreadable)) return folder;
  throw std::runtime_error(source + ": '" + folder + "': no such folder; give one that exists, or leave it out");
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::string program_folder() { return fs::read_symlink("/proc/self/exe").parent_path().string(); }

bool is_installed() {
  std::error_code unreadable;
  return fs::is_directory(installed_folder(), unreadable);
}

std::string shipped_lua_folder() {
  const fs::path folder = file_of("lua", LIANA_SOURCE_LUA_DIR);
  std::error_code unreadable;
  if (fs::is_directory(folder, unreadable)) return folder.string();
  throw std::runtime_error("Liana's Lua files are not at " + folder.string() + " nor at " +
                           (installed_folder() / "lua").string() + ": install it again (docs/how-to/install.md)");
}

std::vector<std::string> lua_folders() {
  std::vector<std::string> folders;
  std::istringstream words(environment(kLuaPath));
  for (std::string word; std::getline(words, word, ':');) {
    if (!word.empty()) folders.push_back(checked_folder(kLuaPath, word));
  }
  folders.push_back(shipped_lua_folder());
  return folders;
}

void search_first(const std::string& option, const std::string& folder) {
  const std::string before = environment(kLuaPath);
  const std::string absolute = fs::absolute(checked_folder(option, folder)).string();
  if (absolute.find(':') != std::string::npos)
    throw std::runtime_error(option + ": '" + absolute + "': has a ':', which separates folders; give another folder");
  ::setenv(kLuaPath, (before.empty() ? absolute : absolute + ":" + before).c_str(), 1);
}

std::string page_file(const std::string& name) { return (file_of("page", LIANA_SOURCE_PAGE_DIR) / name).string(); }

}  // namespace liana::install_paths
