#include "host/apps/cli/run_choice.hpp"

#include <cstdio>
#include <filesystem>
#include <vector>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/runs.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/schema.hpp"

namespace liana::cli {
namespace {

namespace fs = std::filesystem;

std::string name_of(const std::string& folder) { return fs::path(folder).filename(); }

bool has_ended(const std::string& folder) {
  try {
    return archive::Reader(folder).is_finished();
  } catch (const std::runtime_error&) {
    return false;  // what cannot be read is looked at only by name
  }
}

}  // namespace

std::string named_run(const std::string& command, const std::string& run) {
  if (fs::exists(run)) return run;
  const std::string runs = launcher::runs_folder(), kept = runs + "/" + run;
  if (run.find('/') == std::string::npos && !runs.empty() && fs::is_directory(kept)) return kept;
  throw launcher::BadInput(command + ": '" + run + "': no such folder, and no run in " + runs +
                           "; allowed: a folder of a run, or a name of liana log list");
}

std::string newest_run_with(const std::string& command, const std::string& file) {
  for (const std::string& folder : launcher::kept_runs(launcher::runs_folder())) {
    if (fs::exists(folder + "/" + file)) return folder;
  }
  throw launcher::BadInput(command + ": '" + launcher::runs_folder() +
                           "' keeps no run yet; run a mission, or name the " + "folder of a run");
}

std::string archive_folder(const std::string& command, const std::string& run) {
  if (run.empty()) return newest_run_with(command, archive::kArchiveFile);
  const fs::path found = named_run(command, run), folder = fs::is_directory(found) ? found : found.parent_path();
  if (fs::exists(folder / archive::kArchiveFile)) return folder.empty() ? "." : folder.string();
  throw launcher::BadInput(command + ": '" + run + "': holds no " + archive::kArchiveFile +
                           "; give the folder of a run (liana log list)");
}

std::string last_ended_run(const std::string& command) {
  std::vector<std::string> runs = launcher::kept_runs(launcher::runs_folder());
  std::erase_if(runs, [](const std::string& folder) { return !fs::exists(folder + "/" + archive::kArchiveFile); });
  if (runs.empty()) return newest_run_with(command, archive::kArchiveFile);
  for (const std::string& folder : runs) {
    if (!has_ended(folder)) continue;
    if (folder != runs.front())
      std::fprintf(stderr, "liana: this is %s, which ended last; %s goes on, or was killed: liana %s %s shows it\n",
                   name_of(folder).c_str(), name_of(runs.front()).c_str(), command.c_str(),
                   name_of(runs.front()).c_str());
    return folder;
  }
  return runs.front();
}

}  // namespace liana::cli
