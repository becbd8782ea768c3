#include "host/base/options/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "host/base/options/nearest.hpp"

namespace liana::options {
namespace {

constexpr int kBadInput = 2;  // of every program

std::string whole_number_problem(const std::string& text) {
  for (const char letter : text) {
    if (letter < '0' || letter > '9') return "'" + text + "': allowed: a whole number, 0 or more";
  }
  return "";
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

// Those of the program and of its commands.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const CLI::App* command : commands_of(app)) {
    for (const std::string& name : option_names(*command)) names.push_back(name);
  }
  return names;
}

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The first option that nobody knows; empty where there is none. It is named whatever else is wrong or missing.
std::string unknown_option(const std::vector<std::string>& known, int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string name = word.substr(0, word.find('='));
    if (word == "--") break;
    if (name.starts_with("--") && !is_one_of(name, known)) return name;
  }
  return "";
}

// A suggestion where the first word that is no option is no command either.
std::string near_command(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const CLI::Option* option = app.get_option_no_throw(word);
    if (!word.starts_with("-")) return is_one_of(word, names) ? "" : did_you_mean(word, names);
    if (option != nullptr && option->get_items_expected_max() > 0) ++i;
  }
  return "";
}

int refused(const std::string& program, const std::string& problem) {
  const char* see = problem.ends_with('?') ? " See" : "; see";
  std::fprintf(stderr, "%s: %s%s %s --help\n", program.c_str(), problem.c_str(), see, program.c_str());
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
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ",") + word;
  const auto problem = [words, list](const std::string& text) {
    return is_one_of(text, words) ? "" : "'" + text + "': allowed: " + allowed_names(text, words);
  };
  option_->check(problem, "{" + list + "}");
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
  const std::vector<std::string> options = option_names(*app_);
  const std::string unknown = unknown_option(options, argc, argv);
  if (!unknown.empty()) return refused(program, unknown + ": no such option" + did_you_mean(unknown, options));
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app_->exit(error)
                                      : refused(program, error.what() + near_command(*app_, argc, argv));
  }
  return std::nullopt;
}

}  // namespace liana::options
