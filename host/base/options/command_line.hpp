// The command line of a program. CLI11 is behind it, in one file: its header takes longer to compile than most
// programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace liana::options {

// One option, for what is to be said about it besides its name. Cheap to copy; good while its CommandLine lives.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  // Without it the command line is refused.
  Option& required();
  // --help shows the value it has now.
  Option& with_default_shown();
  // Every other value is refused.
  Option& one_of(const std::vector<std::string>& words);
  // A value that is no existing folder is refused.
  Option& existing_folder();

 private:
  CLI::Option* option_;
};

// The options that belong together: those of the program, or of one of its commands. Cheap to copy; good while its
// CommandLine lives.
class Command {
 public:
  // An option with a value ("--api"), or a word at its place ("directory"). `value` is set by parse() when it is given.
  Option option(const std::string& name, std::string& value, const std::string& about);
  Option option(const std::string& name, std::uint64_t& value, const std::string& about);
  Option option(const std::string& name, double& value, const std::string& about);
  // An option without a value.
  void flag(const std::string& name, bool& value, const std::string& about);
  // A command below this one; exactly one of them must be given.
  Command command(const std::string& name, const std::string& about);
  // Whether this command was given.
  bool chosen() const;

 protected:
  explicit Command(CLI::App& app) : app_(&app) {}
  CLI::App* app_;
};

// The whole command line.
class CommandLine : public Command {
 public:
  // `about` stands above --help; `name` is what the program calls itself there, as it was called where empty.
  explicit CommandLine(const std::string& about, const std::string& name = "");
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // Sets the values. Returns the exit code when there is nothing left to do: 0 after --help and --version (every
  // program has them), else 2, and what is wrong has been written to standard error.
  std::optional<int> parse(int argc, const char* const* argv);
};

}  // namespace liana::options
