// The facts of a message are compared as tests/message.hpp says; message.py does the same.
#include "tests/message.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace liana {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

TEST(Facts, AreWholeWordsOfEitherCase) {
  for (const auto& [text, fact] : Pairs{{"hold[9]: 45: allowed -20 to 20 deg", "hold[9]"},
                                        {"hold[9]: 45: allowed -20 to 20 deg", "-20"},
                                        {"hold[9]: 45: allowed -20 to 20 deg", "20"},
                                        {"Drive 4 is off by +3.3 mm.", "drive 4"},
                                        {"Drive 4 is off by +3.3 mm.", "3.3 mm"},
                                        {"--from: 'nan'", "--from"},
                                        {"/tmp/x/given.lua:3: steer.node: 9", "given.lua:3"}})
    EXPECT_TRUE(names(text, {fact}));
}

TEST(Facts, AreNoPartsOfNumbersNamesPathsOrOptions) {
  for (const auto& [text, fact] : Pairs{{"0.2 12 -2 joint_2 2.5", "2"},
                                        {"steer.node steer[1] steering", "steer"},
                                        {"--from-deg", "--from"},
                                        {"liana-bench", "bench"}})
    EXPECT_FALSE(names(text, {fact})) << text << ": " << fact;
}

TEST(Facts, StandAllInOneLineOfTwoSentencesAtMost) {
  const std::string text = "a heading\nspeed_m_s is 7 m/s, maximum 5 m/s. Ask for less.\n";
  EXPECT_TRUE(names(text, {"speed_m_s", "7 m/s", "5 m/s"}));
  EXPECT_FALSE(names(text, {"speed_m_s", "heading"}));
  EXPECT_FALSE(names("One 5. Two. Three.", {"5"}));
  EXPECT_FALSE(names("", {"5"}));
  EXPECT_FALSE(names(text, {})) << "a test that looks for nothing";
  EXPECT_FALSE(names(text, {""}));
}

TEST(Facts, ThatAreMissingAreNamed) {
  const std::string said = names("speed_m_s: 7", {"speed_m_s", "5"}).message();
  EXPECT_NE(said.find("'5'"), std::string::npos) << said;
  EXPECT_EQ(said.find("'speed_m_s'"), std::string::npos) << said;
}

}  // namespace
}  // namespace liana
