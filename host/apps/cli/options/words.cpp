#include "host/apps/cli/options/words.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "host/apps/cli/known_values.hpp"
#include "host/apps/cli/options/options.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/options/nearest.hpp"

namespace liana::cli {
namespace {

// `--hold= --json` must not read `--json` as the value of --hold, and an unset shell variable must not mean
// "everything" or "nothing".
void check_values(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word.empty()) throw launcher::BadInput("an argument is empty (''); give a value, or leave the option out");
    if (word.starts_with("--") && word.ends_with('='))
      throw launcher::BadInput(word + ": no value after =; give one, or leave the option out");
  }
}

// An option that its command does not know is named, whatever else is missing. `before`: the command's words, each with
// a blank.
void check_options(const CLI::App& command, const std::string& before, std::span<const std::string> words) {
  for (const std::string& word : words) {
    if (word == "--") return;
    const std::string option = word.substr(0, word.find('='));
    if (word.starts_with("--") && option != "--help" && command.get_option_no_throw(option) == nullptr)
      throw launcher::BadInput(option + ": liana " + before + "has no such option; see liana " + before + "--help");
  }
}

// Whether a command that has commands below it takes other words, too: the FILE of campaign.
bool takes_words(const CLI::App& command) {
  const std::vector<const CLI::Option*> all = command.get_options();
  return std::any_of(all.begin(), all.end(), [](const CLI::Option* option) { return option->get_positional(); });
}

// A word in place of a command that is none gets the list of those that are; `before` are the words before it.
void check_command(const CLI::App& app, const std::string& before, std::span<const std::string> words) {
  std::string names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + sub->get_name();
    if (!words.empty() && words.front() == sub->get_name())
      return check_command(*sub, before + words.front() + " ", words.subspan(1));
  }
  if (names.empty() || takes_words(app) || (!words.empty() && words.front().starts_with('-')))
    return check_options(app, before, words);
  const std::string problem = words.empty() ? "no command given" : "'" + before + words.front() + "': no such command";
  throw launcher::BadInput(problem + "; liana " + before + "knows: " + names + "; see liana help");
}

// `help` is followed by a command's words and nothing else; one that is no command gets check_command's list.
void check_help(const CLI::App& app, std::span<const std::string> words) {
  const CLI::App* command = &app;
  for (const std::string& word : words) {
    const auto all = command->get_subcommands([](const CLI::App*) { return true; });
    if (all.empty())
      throw launcher::BadInput("help: '" + word + "': liana " + command->get_name() +
                               " has no commands of its own; allowed: liana help, or liana help COMMAND");
    const auto below =
        std::find_if(all.begin(), all.end(), [&](const CLI::App* sub) { return sub->get_name() == word; });
    if (below == all.end()) return;
    command = *below;
  }
}

// The words from the command on: only --lua-dir may stand before it.
std::span<const std::string> after_global_options(std::span<const std::string> words) {
  while (!words.empty()) {
    if (words.front().starts_with(std::string(kLuaDir) + "=")) {
      words = words.subspan(1);
    } else if (words.front() == kLuaDir && words.size() > 1) {
      words = words.subspan(2);
    } else {
      return words;
    }
  }
  return words;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// The known name near a value that is none, where there is a list of what may stand there. Numbers are no names.
std::string near_value(const std::string& option_or_command, const std::string& value) {
  const bool is_name = !value.empty() && std::isalpha(static_cast<unsigned char>(value.front())) != 0 &&
                       value.find_first_of("/.") == value.npos;
  if (!is_name || std::filesystem::exists(value)) return "";
  const std::vector<std::string> known = values_after(option_or_command);
  const bool is_known = std::find(known.begin(), known.end(), value) != known.end();
  return is_known ? "" : options::did_you_mean(value, known);
}

struct Chosen {
  const CLI::App* command;
  std::string words;  // of it, each after a blank
};

// The command that was being read.
Chosen chosen(const CLI::App& app) {
  Chosen found{&app, ""};
  while (!found.command->get_subcommands().empty()) {
    found.command = found.command->get_subcommands().front();
    found.words += " " + found.command->get_name();
  }
  return found;
}

}  // namespace

std::vector<std::string> arguments_of(const CLI::App& app, std::vector<std::string> words) {
  const auto command = words.end() - std::ssize(after_global_options(words));
  if (command != words.end() && *command == "help") {
    check_help(app, {std::next(command), words.end()});
    words.erase(command);
    words.push_back("--help");
  }
  check_values(words);
  check_command(app, "", after_global_options(words));
  std::reverse(words.begin(), words.end());  // as CLI11 wants it
  return words;
}

void check_words_of_run(const std::vector<std::string>& words) {
  struct Line {
    CLI::App app{"", "liana"};
    Action action;
    Line() { declare_all(app, action); }
  };
  static Line line;
  try {
    line.app.parse(arguments_of(line.app, words));
  } catch (const CLI::ExtrasError&) {
    throw launcher::BadInput(extra_word_text(line.app) + suggestion(line.app, words));
  } catch (const CLI::ArgumentMismatch& error) {
    throw launcher::BadInput(missing_value_text(line.app, error.what()) + suggestion(line.app, words));
  } catch (const CLI::ParseError& error) {
    throw launcher::BadInput(problem_text(line.app, error.what()) + suggestion(line.app, words));
  } catch (const launcher::BadInput& error) {
    throw launcher::BadInput(error.what() + suggestion(line.app, words));
  }
}

std::string missing_value_text(const CLI::App& app, const std::string& error) {
  const auto [command, words] = chosen(app);
  const std::string name = error.substr(0, error.find(':'));
  const CLI::Option* option = name.starts_with("--") ? command->get_option_no_throw(name) : nullptr;
  const std::string see = "; see liana" + words + " --help";
  if (option != nullptr && option->count() > 1)
    return name + ": stands " + std::to_string(option->count()) + " times; give it once" + see;
  return option == nullptr ? error + see : name + ": no value given; allowed: " + option->get_description() + see;
}

std::string problem_text(const CLI::App& app, const std::string& error) {
  const std::string words = chosen(app).words;
  return error + "; see liana" + (words.empty() ? " help" : words + " --help");
}

std::string extra_word_text(const CLI::App& app) {
  const std::string command = chosen(app).words;
  const std::vector<std::string> words = app.remaining(true);
  return "'" + (words.empty() ? "" : words.front()) + "': liana" + command +
         " takes no such word; leave it out, or see liana" + command + " --help";
}

std::string suggestion(const CLI::App& app, std::span<const std::string> words) {
  words = after_global_options(words);
  const CLI::App* command = &app;
  std::string path = "liana", near;
  for (std::size_t i = 0; i < words.size() && near.empty(); ++i) {
    const std::string& word = words[i];
    const auto below = command->get_subcommands([](const CLI::App*) { return true; });
    if (word.starts_with("--")) {
      const std::size_t equals = word.find('=');
      const std::string name = word.substr(0, equals);
      const CLI::Option* option = command->get_option_no_throw(name);
      if (option == nullptr) {
        near = options::did_you_mean(name, options_of(*command));
      } else if (equals != word.npos) {
        near = near_value(name, word.substr(equals + 1));
      } else if (option->get_items_expected_max() > 0 && i + 1 < words.size()) {
        near = near_value(name, words[++i]);
      }
    } else if (below.empty()) {
      near = near_value(path, word);
    } else if (i > 0 || word != "help") {
      const auto found =
          std::find_if(below.begin(), below.end(), [&](const auto* sub) { return sub->get_name() == word; });
      if (found == below.end()) {
        near = options::did_you_mean(word, names_of(below));
        if (!near.empty() || !takes_words(*command)) return near;
        near = near_value(path, word);
        continue;
      }
      command = *found;
      path += " " + word;
    }
  }
  return near;
}

bool prints_json(std::span<const std::string> words) {
  words = after_global_options(words);
  const auto json = std::find_if(words.begin(), words.end(),
                                 [](const std::string& word) { return word == "--json" || word == "--json=-"; });
  if (json == words.end()) return false;
  const bool wants_file = words.front() == "run" || words.front() == "check";
  return !wants_file || *json == "--json=-" || (json + 1 != words.end() && json[1] == "-");
}

std::vector<CommandHelp> help_of(const CLI::App& app, const std::string& path) {
  std::vector<CommandHelp> all{{path, {}}};
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    all.front().words.push_back({sub->get_name(), sub->get_description()});
    const std::vector<CommandHelp> below = help_of(*sub, path + " " + sub->get_name());
    all.insert(all.end(), below.begin(), below.end());
  }
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      all.front().words.push_back({"--" + name, option->get_description()});
  }
  return all;
}

}  // namespace liana::cli
