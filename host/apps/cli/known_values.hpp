// What may follow an option, or stand in a command, where there is a list of it: for completion, and for who misspells.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace liana::cli {

struct KnownValues {
  const char* after;  // "--robot", or "liana run" for a word of that command
  const char* table;  // a folder of tables whose names may stand there; empty: none
  const char* words;  // others, with blanks between
  bool files;
};

std::span<const KnownValues> known_values();

// The names that there are in the Lua folders, in alphabetical order; `table` is robots, scenes, buses or the like.
std::vector<std::string> table_names(const std::string& table);

// All that may stand there but files; empty where there is no list of it.
std::vector<std::string> values_after(const std::string& option_or_command);

}  // namespace liana::cli
