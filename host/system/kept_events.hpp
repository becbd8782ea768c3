// Events and commands of this user's newest runs, also of those that keep nothing else.
#pragma once

#include <cstddef>
#include <string>

namespace liana::system {

constexpr std::size_t kKeptRuns = 20;

// $XDG_STATE_HOME/liana/events, without that variable $HOME/.local/state/liana/events; empty without either.
std::string kept_events_folder();
// The same with commands in place of events: what became of every command.
std::string kept_commands_folder();

// Copies a file of the run `name` into `folder`, which is made, as NAME.txt, and removes the oldest there
// beyond kKeptRuns. Throws std::runtime_error with file and reason.
void keep_events(const std::string& file, const std::string& name, const std::string& folder);

}  // namespace liana::system
