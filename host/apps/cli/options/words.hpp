// The words of a command line: what is wrong with them, said before and after the library reads them, and what they are
// when help or JSON is asked for.
#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string>
#include <vector>

#include "host/apps/cli/commands.hpp"

namespace liana::cli {

constexpr const char* kLuaDir = "--lua-dir";  // the only option with a value that stands before the command

// The words as CLI11 wants them, last one first; `help` and `help COMMAND` are `--help` and `COMMAND --help`. Throws
// BadInput: an empty word, an option without its value, a command or an option that does not exist.
std::vector<std::string> arguments_of(const CLI::App& app, std::vector<std::string> words);

// Reads the words as a command line without carrying it out. Throws BadInput with the message that they would get.
void check_words_of_run(const std::vector<std::string>& words);

// An option at the end of the line, or before another one, whose value was forgotten: what its value may be is said;
// or one that stands more than once.
// `error`: CLI11's text.
std::string missing_value_text(const CLI::App& app, const std::string& error);

// What else is wrong, and where the command that was read is explained.
std::string problem_text(const CLI::App& app, const std::string& error);

// A word that the command has no place for.
std::string extra_word_text(const CLI::App& app);

// "; did you mean NAME?" for the end of a refusal: of the first command, option or value of an option that is unknown
// and near to a known one; empty where there is none.
std::string suggestion(const CLI::App& app, std::span<const std::string> words);

// Whether standard output takes JSON: with --json; of `run` and `check`, whose --json wants a file, where that is -.
bool prints_json(std::span<const std::string> words);

// The options and commands of `app` and of all commands below it.
std::vector<CommandHelp> help_of(const CLI::App& app, const std::string& path);

}  // namespace liana::cli
