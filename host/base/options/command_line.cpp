#include "host/base/options/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

namespace liana::options {
namespace {

constexpr int kBadInput = 2;  // of every program

std::string whole_number_problem(const std::string& text) {
  for (const char letter : text) {
    if (letter < '0' || letter > '9') return "'" + text + "': allowed: a whole number, 0 or more";
  }
  return "";
}

bool has_option(const CLI::App& app, const std::string& name) {
  if (app.get_option_no_throw(name) != nullptr) return true;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (has_option(*command, name)) return true;
  }
  return false;
}

// The first option that nobody knows; empty where there is none. It is named whatever else is wrong or missing.
std::string unknown_option(const CLI::App& app, int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string name = word.substr(0, word.find('='));
    if (word == "--") break;
    if (name.starts_with("--") && !has_option(app, name)) return name;
  }
  return "";
}

int refused(const std::string& program, const std::string& problem) {
  std::fprintf(stderr, "%s: %s; see %s --help\n", program.c_str(), problem.c_str(), program.c_str());
  return kBadInput;
}

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
  return Option(*app_->add_option(name, value, about)->check(whole_number_problem));  // -1 would wrap
}

Option Command::option(const std::string& name, double& value, const std::string& about) {
  return Option(*app_->add_option(name, value, about));
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
  const std::string path = argv[0], program = path.substr(path.rfind('/') + 1);
  app_->set_version_flag("--version", program + " " LIANA_VERSION, "say which version");
  const std::string unknown = unknown_option(*app_, argc, argv);
  if (!unknown.empty()) return refused(program, unknown + ": no such option");
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app_->exit(error) : refused(program, error.what());
  }
  return std::nullopt;
}

}  // namespace liana::options
