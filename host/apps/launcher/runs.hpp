// The newest runs of this user, each a folder that the run itself writes: what happened is there also without --record.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/apps/launcher/folder_lock.hpp"

namespace liana::launcher {

constexpr std::size_t kKeptRuns = 20;

// $XDG_STATE_HOME/liana/runs, without that variable $HOME/.local/state/liana/runs; empty without either.
std::string runs_folder();

// Folders of runs, the one that changed last first; none where there is no such folder.
std::vector<std::string> kept_runs(const std::string& folder);

// The folder of a new run, liana-run-XXXXXX, and its lock: the file `lock` has the folder's name and a number that
// grows from run to run.
struct RunFolder {
  std::string path;
  FolderLock lock;
};

// Makes the folder of a new run and holds it. Throws std::runtime_error with path and reason.
RunFolder make_run_folder(const std::string& folder);

// Of a run that succeeded: takes away what nobody looks at then (logs, bus traffic).
void keep_what_lasts(const std::string& run);

// Removes the runs with the smallest numbers beyond kKeptRuns that nobody holds. Dates do not count, as clocks are set
// back. What has no lock file with the folder's own name in it was put there by hand, and stays.
void remove_oldest_runs(const std::string& folder);

}  // namespace liana::launcher
