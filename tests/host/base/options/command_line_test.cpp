// What a command line sets, and what it refuses.
#include "host/base/options/command_line.hpp"

#include <gtest/gtest.h>

namespace liana::options {
namespace {

// A program with one command, and what a command line made of it.
struct Program {
  std::string api, time = "fast", folder = ".";
  std::uint64_t seed = 1;
  bool lockstep = false;
  bool runs = false;

  std::optional<int> parse(std::vector<const char*> words) {
    CommandLine line("about", "program");
    line.option("--time", time, "how").one_of({"fast", "real"}).with_default_shown();
    line.option("--folder", folder, "where").existing_folder();
    Command run = line.command("run", "runs");
    run.option("--api", api, "socket").required();
    run.option("--seed", seed, "seed");
    run.flag("--lockstep", lockstep, "flag");
    words.insert(words.begin(), "program");
    const auto code = line.parse(static_cast<int>(words.size()), words.data());
    runs = run.chosen();
    return code;
  }
};

TEST(CommandLine, SetsWhatIsGivenAndLeavesTheRest) {
  Program program;
  EXPECT_EQ(program.parse({"--time", "real", "run", "--api", "a", "--seed=18446744073709551615", "--lockstep"}),
            std::nullopt);
  EXPECT_EQ(program.time, "real");
  EXPECT_EQ(program.folder, ".");
  EXPECT_EQ(program.api, "a");
  EXPECT_EQ(program.seed, 18446744073709551615u);
  EXPECT_TRUE(program.lockstep && program.runs);
}

TEST(CommandLine, HelpIsTheEndWithoutAnError) {
  EXPECT_EQ(Program().parse({"--help"}), 0);
  EXPECT_EQ(Program().parse({"run", "--help"}), 0);
}

TEST(CommandLine, WhatBreaksARuleIsRefused) {
  const std::vector<std::vector<const char*>> wrong = {{},
                                                       {"walk"},
                                                       {"run"},
                                                       {"run", "--api"},
                                                       {"run", "--api", "a", "--seed", "-1"},
                                                       {"run", "--api", "a", "--seed", "many"},
                                                       {"run", "--api", "a", "--other"},
                                                       {"--time", "slow", "run", "--api", "a"},
                                                       {"--folder", "/no/such/folder", "run", "--api", "a"}};
  for (std::size_t i = 0; i < wrong.size(); ++i) EXPECT_GT(Program().parse(wrong[i]).value_or(0), 0) << i;
}

TEST(CommandLine, TheProgramSaysItsNameTheProblemAndWhereMoreStands) {
  const auto said = [](const std::vector<const char*>& words) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(Program().parse(words), 2);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said({"run", "--other"}), "program: --other: no such option; see program --help\n")
      << "--api is missing, too";
  EXPECT_EQ(said({"run"}), "program: --api is required; see program --help\n");
  EXPECT_EQ(said({"run", "--api", "a", "--seed", "-1"}),
            "program: --seed: '-1': allowed: a whole number, 0 or more; see program --help\n");
}

TEST(CommandLine, WhatIsMisspeltIsNamedAsItIsSpelt) {
  const std::vector<std::pair<std::vector<const char*>, std::vector<std::string>>> wrong = {
      {{"run", "--apy", "a"}, {"--apy", "--api"}},
      {{"run", "--api", "a", "--lokstep"}, {"--lokstep", "--lockstep"}},
      {{"rnu", "--api", "a"}, {"run"}},
      {{"--time", "rael", "run", "--api", "a"}, {"--time", "rael", "fast", "real"}}};
  for (const auto& [words, facts] : wrong) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(Program().parse(words), 2);
    const std::string said = testing::internal::GetCapturedStderr();
    for (const std::string& fact : facts) EXPECT_NE(said.find(fact), std::string::npos) << said;
    EXPECT_NE(said.find("did you mean"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace liana::options
