#include "host/apps/launcher/runs.hpp"

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;

// How the names begin: beside a file of SQLite may lie two that belong to it.
constexpr std::array<std::string_view, 13> kLasting{
    "archive.db",   "telemetry-",  "ring-",     "robot.json", "scene.json",    "buses.json", "events.txt",
    "commands.txt", "report.json", "truth.bin", "page.html",  "mission_files", kLockFile};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

constexpr const char* kPage = "page.html";

// A run that goes on writes, so that it is never old.
fs::file_time_type newest_change(const fs::path& run) {
  std::error_code gone;  // other runs end at the same time
  fs::file_time_type newest = fs::file_time_type::min();
  for (const fs::directory_entry& entry : fs::directory_iterator(run, gone)) {
    if (entry.path().filename() == kPage) continue;  // made whenever somebody looks
    const fs::file_time_type when = entry.last_write_time(gone);
    if (!gone) newest = std::max(newest, when);
  }
  return newest;
}

constexpr std::string_view kNameBegins = "liana-run-";
constexpr std::uint64_t kMaxNumber = std::uint64_t{1} << 53;  // more was not written by a run

// The number of a folder that a run made and that has the name which it had then; a copy of it has another one.
std::optional<std::uint64_t> number_of_run(const fs::path& folder) {
  std::error_code gone;
  if (!fs::is_directory(fs::symlink_status(folder, gone)) ||
      !fs::is_regular_file(fs::symlink_status(folder / kLockFile, gone)))
    return std::nullopt;
  std::ifstream file(folder / kLockFile);
  std::string name;
  std::uint64_t number = 0;
  if (!(file >> name >> number) || name != folder.filename() || number > kMaxNumber) return std::nullopt;
  return number;
}

struct NumberedRun {
  std::uint64_t number;
  fs::file_time_type when;  // of equals, as runs that began together are
  std::string folder;
  auto operator<=>(const NumberedRun&) const = default;
};

// The newest first.
std::vector<NumberedRun> numbered_runs(const std::string& folder) {
  std::vector<NumberedRun> runs;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const auto number = number_of_run(entry.path());
    if (number) runs.push_back({*number, newest_change(entry.path()), entry.path()});
  }
  std::sort(runs.rbegin(), runs.rend());
  return runs;
}

}  // namespace

std::string runs_folder() {
  const std::string state = variable("XDG_STATE_HOME"), home = variable("HOME");
  if (!state.empty()) return state + "/liana/runs";
  return home.empty() ? "" : home + "/.local/state/liana/runs";
}

std::vector<std::string> kept_runs(const std::string& folder) {
  std::vector<std::pair<fs::file_time_type, std::string>> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (entry.is_directory(none)) found.emplace_back(newest_change(entry.path()), entry.path());
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<std::string> runs;
  for (auto& [when, run] : found) runs.push_back(std::move(run));
  return runs;
}

RunFolder make_run_folder(const std::string& folder) {
  if (folder.empty())
    throw std::runtime_error("neither XDG_STATE_HOME nor HOME is set: set one, for the folder of runs");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": cannot be made: " + error.message());
  const std::vector<NumberedRun> others = numbered_runs(folder);
  const std::uint64_t number = others.empty() ? 1 : others.front().number + 1;
  std::string path = folder + "/" + std::string(kNameBegins) + "XXXXXX";
  if (mkdtemp(path.data()) == nullptr) throw std::runtime_error(folder + ": no folder can be made there");
  const std::string name = fs::path(path).filename();
  return {path, hold_new_folder(path, name + " " + std::to_string(number) + "\n")};
}

void keep_what_lasts(const std::string& run) {
  std::error_code gone;
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(run, gone)) {
    const std::string name = entry.path().filename();
    const bool lasts =
        std::any_of(kLasting.begin(), kLasting.end(), [&](auto begin) { return name.starts_with(begin); });
    if (!lasts) others.push_back(entry.path());
  }
  for (const fs::path& each : others) fs::remove_all(each, gone);
}

void remove_oldest_runs(const std::string& folder) {
  const std::vector<NumberedRun> runs = numbered_runs(folder);
  for (std::size_t i = kKeptRuns; i < runs.size(); ++i) {
    if (const FolderLock lock = take_unheld_folder(runs[i].folder)) remove_held_folder(runs[i].folder);
  }
}

}  // namespace liana::launcher
