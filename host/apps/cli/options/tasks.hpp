// Every command of `liana` in help: its group by task, what it does in one line, and an example.
#pragma once

#include <CLI/CLI.hpp>

#include <span>

namespace liana::cli {

struct CommandText {
  const char* path;     // "liana robot export"
  const char* group;    // heading over it in the help of the command above it
  const char* about;    // what it does, one line
  const char* example;  // a line for a shell
};

// A row for every command, `liana` itself first; the commands of a group stand together, in the order of help.
std::span<const CommandText> command_texts();

// Gives a command and all below it their lines, groups and examples. Throws std::logic_error for one without a row.
void explain(CLI::App& app);

}  // namespace liana::cli
