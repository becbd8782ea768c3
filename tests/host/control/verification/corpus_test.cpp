// The corpus: no command that has to be refused is accepted, and none that is well within its limits is refused.
#include "tests/host/control/verification/corpus.hpp"

#include <gtest/gtest.h>

#include "tests/rounds.hpp"

namespace liana::verification::corpus {
namespace {

class Corpus : public testing::TestWithParam<Class> {};

// req:C8 req:C9
TEST_P(Corpus, HasTheVerdictsThatAreKnown) {
  const std::vector<Command> commands = GetParam().commands(0);
  EXPECT_GE(commands.size(), GetParam().least);
  const std::size_t step = commands.size() / rounds(rounds(commands.size()));  // ./dev test runs the whole, too
  for (std::size_t i = 0; i < commands.size(); i += step) {
    const Command& command = commands[i];
    const SimulationVerdict verdict = verdict_of(command);
    EXPECT_EQ(static_cast<int>(verdict.code), static_cast<int>(command.expected))
        << command.name << ": " << verdict.text << "; margin " << verdict.margins.clearance_m << " m, "
        << verdict.margins.tension_N << " N, first " << verdict.first.body << " at " << verdict.first.time_s;
    EXPECT_FALSE(verdict.passed() && command.expected != Refusal::kNone) << "wrong accept";
  }
}

INSTANTIATE_TEST_SUITE_P(Classes, Corpus, testing::ValuesIn(kClasses),
                         [](const testing::TestParamInfo<Class>& info) { return info.param.name; });

}  // namespace
}  // namespace liana::verification::corpus
