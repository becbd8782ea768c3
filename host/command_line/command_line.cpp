#include "host/command_line/command_line.hpp"

#include <CLI/CLI.hpp>

namespace liana::command_line {
namespace {

constexpr int kBadInput = 2;  // of every program

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::with_default_shown() {
  option_->capture_default_str();
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

Option& Option::existing_folder() {
  option_->check(CLI::ExistingDirectory);
  return *this;
}

Option Command::option(const std::string& name, std::string& value, const std::string& about) {
  return Option(*app_->add_option(name, value, about));
}

Option Command::option(const std::string& name, std::uint64_t& value, const std::string& about) {
  return Option(*app_->add_option(name, value, about)->check(CLI::NonNegativeNumber));  // -1 would wrap
}

void Command::flag(const std::string& name, bool& value, const std::string& about) {
  app_->add_flag(name, value, about);
}

Command Command::command(const std::string& name, const std::string& about) {
  app_->require_subcommand(1);
  return Command(*app_->add_subcommand(name, about));
}

bool Command::chosen() const { return app_->parsed(); }

CommandLine::CommandLine(const std::string& about, const std::string& name) : Command(*new CLI::App(about, name)) {}

CommandLine::~CommandLine() { delete app_; }

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  const std::string program = argv[0];
  app_->set_version_flag("--version", program.substr(program.rfind('/') + 1) + " " LIANA_VERSION, "say which version");
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? 0 : kBadInput;
  }
  return std::nullopt;
}

}  // namespace liana::command_line
