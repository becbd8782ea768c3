// The corpus: no command that has to be refused is accepted, and none that is well within its limits is refused.
#include "tests/host/verify/corpus.hpp"

#include <gtest/gtest.h>

namespace liana::verify::corpus {
namespace {

struct Class {
  const char* name;
  std::vector<Command> (*commands)();
  std::size_t least;  // how many there are at least
};

class Corpus : public testing::TestWithParam<Class> {};

// req:C8 req:C9
TEST_P(Corpus, HasTheVerdictsThatAreKnown) {
  const std::vector<Command> commands = GetParam().commands();
  EXPECT_GE(commands.size(), GetParam().least);
  for (const Command& command : commands) {
    const SimulationVerdict verdict = verdict_of(command);
    EXPECT_EQ(static_cast<int>(verdict.code), static_cast<int>(command.expected))
        << command.name << ": " << verdict.text << "; margin " << verdict.margins.clearance_m << " m, "
        << verdict.margins.tension_N << " N, first " << verdict.first.body << " at " << verdict.first.time_s;
    EXPECT_FALSE(verdict.passed() && command.expected != Refusal::kNone) << "wrong accept";
  }
}

INSTANTIATE_TEST_SUITE_P(Classes, Corpus,
                         testing::Values(Class{"JointAngle", joint_angles, 40}, Class{"JointRate", joint_rates, 40},
                                         Class{"TipSpeed", tip_speeds, 30}, Class{"NodeSpeed", node_speeds, 20},
                                         Class{"Scene", spheres, 60}, Class{"WayOut", ways_out, 15},
                                         Class{"ThinPlate", thin_plates, 30}, Class{"Self", self_contacts, 30},
                                         Class{"Swing", swings, 24}, Class{"Free", free_motions, 60}),
                         [](const testing::TestParamInfo<Class>& info) { return info.param.name; });

}  // namespace
}  // namespace liana::verify::corpus
