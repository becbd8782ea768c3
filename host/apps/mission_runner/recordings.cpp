#include "host/apps/mission_runner/recordings.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/base/file/in_file.hpp"
#include "host/base/json/json.hpp"

namespace liana::mission_runner {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVrHeader = "liana-hand 1 vr";

bool is_of_vr_handles(const std::string& file) {
  file::require_ordinary(file);
  std::ifstream stream(file);
  std::string first;
  return std::getline(stream, first) && first.starts_with(kVrHeader);
}

void check_recording(const std::string& where, const std::string& name, const std::vector<std::string>& folders) {
  std::string searched;
  for (const std::string& folder : folders) {
    const std::string file = folder + "/" + name + ".hand";
    if (fs::is_regular_file(file)) {
      if (is_of_vr_handles(file)) return;
      throw std::runtime_error(where + ": task: " + name + ": " + file + " holds no VR handles: allowed a file that " +
                               "begins with \"" + kVrHeader + "\": name another recording");
    }
    searched += (searched.empty() ? "" : ", ") + folder;
  }
  throw std::runtime_error(where + ": task: " + name + ": no recording " + name + ".hand: allowed one in " + searched +
                           ": put it there, correct the name, or remove task");
}

}  // namespace

std::vector<std::string> recording_folders(const LuaFolders& lua_folders, const std::string& mission_folder) {
  std::vector<std::string> folders{fs::absolute(mission_folder).lexically_normal().string()};
  for (const std::string& folder : lua_folders.in_turn) folders.push_back(folder + "/recordings");
  return folders;
}

void check_recordings(const Json& description, const std::vector<std::string>& folders) {
  int number = 0;
  for (const Json& step : description.at("steps")) {
    ++number;
    const std::string task = step.value("task", "");
    if (task.empty() || step.value("device", "") != "vr") continue;
    check_recording(step.value("at", "") + "mission " + description.value("name", "") + ": step " +
                        std::to_string(number) + " \"" + step.value("name", "") + "\"",
                    task, folders);
  }
}

}  // namespace liana::mission_runner
