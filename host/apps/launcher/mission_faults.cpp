#include "host/apps/launcher/mission_faults.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "host/apps/launcher/errors.hpp"
#include "host/base/json/json.hpp"
#include "host/base/options/nearest.hpp"

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string fault_file(const Json& mission, const std::string& name) {
  const Json files = mission.is_object() ? mission.value("files", Json::array()) : Json::array();
  const fs::path script = files.empty() ? "" : files.front().value("path", "");
  const fs::path folder = script.parent_path() / script.stem() / "faults";
  const std::vector<std::string> known = names_in(folder);
  if (std::find(known.begin(), known.end(), name) != known.end()) return folder / (name + ".json");
  if (known.empty())
    throw BadInput("--fault: '" + name + "': this mission has no faults of its own (" + folder.string() +
                   "): give a list with --faults FILE (docs/how-to/run-hil.md), or leave it out");
  throw BadInput("--fault: '" + name +
                 "': no such fault of this mission; allowed: " + options::allowed_names(name, known));
}

}  // namespace liana::launcher
