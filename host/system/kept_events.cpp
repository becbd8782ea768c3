#include "host/system/kept_events.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace liana::system {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string kept_folder(const std::string& what) {
  const std::string state = variable("XDG_STATE_HOME"), home = variable("HOME");
  if (!state.empty()) return state + "/liana/" + what;
  return home.empty() ? "" : home + "/.local/state/liana/" + what;
}

void remove_oldest(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> kept;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::error_code gone;  // other runs end at the same time
    const fs::file_time_type when = entry.last_write_time(gone);
    if (!gone && entry.path().extension() == ".txt") kept.emplace_back(when, entry.path());
  }
  std::sort(kept.rbegin(), kept.rend());
  std::error_code gone;
  for (std::size_t i = kKeptRuns; i < kept.size(); ++i) fs::remove(kept[i].second, gone);
}

}  // namespace

std::string kept_events_folder() { return kept_folder("events"); }
std::string kept_commands_folder() { return kept_folder("commands"); }

void keep_events(const std::string& file, const std::string& name, const std::string& folder) {
  if (folder.empty()) throw std::runtime_error(file + ": cannot be kept: neither XDG_STATE_HOME nor HOME is set");
  try {
    fs::create_directories(folder);
    fs::copy_file(file, fs::path(folder) / (name + ".txt"), fs::copy_options::overwrite_existing);
    remove_oldest(folder);
  } catch (const fs::filesystem_error& error) {
    throw std::runtime_error(file + ": cannot be kept in " + folder + ": " + error.code().message());
  }
}

}  // namespace liana::system
