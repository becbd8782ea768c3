// Which run a command is about: a folder, or the name of one of the newest runs (liana log list), the same everywhere.
#pragma once

#include <string>

namespace liana::cli {

// What `run` names: a path that is there, else a run of that name among the newest. Throws BadInput, which begins with
// `command`.
std::string named_run(const std::string& command, const std::string& run);

// The newest run whose folder holds `file`. Throws BadInput where there is none.
std::string newest_run_with(const std::string& command, const std::string& file);

// The folder with the archive of the run that is named, of the newest where `run` is empty. Throws BadInput where there
// is none.
std::string archive_folder(const std::string& command, const std::string& run);

// The run that ended last: those that go on, or whose recorder was killed, are taken only where no other is there. Says
// on standard error which one it takes when a newer one is passed over. Throws BadInput where there is none.
std::string last_ended_run(const std::string& command);

}  // namespace liana::cli
