// What help tells of every command: a group, a line, and an example that the command line takes.
#include <CLI/CLI.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "host/apps/cli/options/options.hpp"
#include "host/apps/cli/options/tasks.hpp"
#include "host/apps/cli/options/words.hpp"

namespace liana::cli {
namespace {

// The commands of one line of examples, each as its words: `liana run lab_tour && liana view`.
std::vector<std::vector<std::string>> commands_in(const std::string& example) {
  std::vector<std::vector<std::string>> commands(1);
  std::istringstream words(example);
  for (std::string word; words >> word;) {
    if (word == "&&") {
      commands.emplace_back();
    } else {
      commands.back().push_back(word);
    }
  }
  return commands;
}

// Reads a command line as `liana` does, without doing what it says; throws what is wrong with it.
void parse(const std::vector<std::string>& words) {
  CLI::App app("", words.front());
  Action action;
  declare_all(app, action);
  app.parse(arguments_of(app, {words.begin() + 1, words.end()}));
  ASSERT_TRUE(action) << "no command was chosen";
}

std::set<std::string> declared_commands() {
  CLI::App app("", "liana");
  Action action;
  declare_all(app, action);
  std::set<std::string> paths;
  for (const CommandHelp& command : help_of(app, "liana")) paths.insert(command.path);
  return paths;
}

TEST(Help, EveryCommandHasOneRowWithGroupLineAndExample) {
  std::multiset<std::string> paths;
  for (const CommandText& row : command_texts()) {
    paths.insert(row.path);
    EXPECT_NE(std::string(row.about), "") << row.path;
    EXPECT_EQ(*row.group == '\0', std::string(row.path) == "liana") << row.path;
    EXPECT_LE(std::string(row.about).size(), 90u) << row.path << ": is no line";
  }
  const std::set<std::string> declared = declared_commands();
  EXPECT_EQ(paths, std::multiset<std::string>(declared.begin(), declared.end()));
}

TEST(Help, CommandsOfAGroupStandTogether) {
  std::set<std::string> ended;
  std::string group;
  for (const CommandText& row : command_texts()) {
    if (row.group == group) continue;
    EXPECT_TRUE(ended.insert(group).second) << row.group;
    EXPECT_FALSE(ended.contains(row.group)) << row.path << ": its group stands twice";
    group = row.group;
  }
}

TEST(Help, TheCommandLineTakesEveryExample) {
  for (const CommandText& row : command_texts()) {
    const std::string path = row.path, example = row.example;
    EXPECT_NE((example + " ").find(path + " "), std::string::npos) << path << " is not in its example";
    for (const std::vector<std::string>& words : commands_in(example)) {
      ASSERT_EQ(words.front(), "liana") << example;
      if (words[1] == "help") continue;  // is read as --help, which ends the reading
      EXPECT_NO_THROW(parse(words)) << example;
    }
  }
}

TEST(Help, ListsTheCommandsByGroupAndEndsWithTheExample) {
  CLI::App app("", "liana");
  Action action;
  declare_all(app, action);
  const std::string help = app.help();
  std::size_t at = 0;
  for (const CommandText& row : command_texts()) {
    const std::string path = row.path, name = path.substr(path.rfind(' ') + 1);
    if (std::count(path.begin(), path.end(), ' ') != 1) continue;
    const std::size_t group = help.find(std::string("\n") + row.group + ":\n");
    const std::size_t line = help.find("\n  " + name + " ");
    ASSERT_NE(group, std::string::npos) << row.group;
    ASSERT_NE(line, std::string::npos) << name;
    EXPECT_GT(line, group) << name;
    EXPECT_GT(line, at) << name;
    at = line;
    EXPECT_TRUE(app.get_subcommand(name)->help().ends_with(std::string("\nExample: ") + row.example + "\n")) << name;
  }
  const std::string log = app.get_subcommand("log")->help();
  for (const char* name : {"list", "show", "export", "verify"})
    EXPECT_NE(log.find(std::string("\n  ") + name + " "), std::string::npos) << log;
}

}  // namespace
}  // namespace liana::cli
