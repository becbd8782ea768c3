// Options of `liana run` for the people who steer.
#include "host/apps/launcher/operator_choice.hpp"

#include <gtest/gtest.h>

#include "host/apps/launcher/errors.hpp"

namespace liana::launcher {
namespace {

std::string choice_refusal(const OperatorChoice& choice) {
  try {
    operator_words(choice);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(OperatorChoice, SaysNothingOfWhatWasNotAskedFor) {
  EXPECT_EQ(operator_words({}), (std::vector<std::string>{"--operator", "recorded"}));
  const std::vector<std::string> human{"--operator", "model", "--delay", "0.5,0.25", "--feedback", "off"};
  EXPECT_EQ(operator_words({"model", "0.5,0.25", "off", "", ""}), human);
}

TEST(OperatorChoice, WhatOnlyAHumanHasIsRefusedOfRecordedHandsByName) {
  for (const OperatorChoice& choice :
       {OperatorChoice{"", "0.5,0.5", "", "", ""}, {"recorded", "", "claim", "", ""}, {"", "", "", "off", ""}}) {
    EXPECT_NE(choice_refusal(choice).find("--operator model"), std::string::npos) << choice_refusal(choice);
  }
}

TEST(OperatorChoice, AnybodyMayBeLively) {
  for (const char* who : {"recorded", "model"}) {
    OperatorChoice choice{.who = who, .temper = "lively"};
    EXPECT_EQ(operator_words(choice), (std::vector<std::string>{"--operator", who, "--temper", "lively"}));
  }
}

TEST(OperatorChoice, ADelayThatIsNoneIsRefusedWithWhatIsAllowed) {
  for (const char* delay : {"x", "0.5", "0.5,", "0.5;0.5", "0.5,0.5,0.5", "-1,0", "0,2.01", "nan,0", "0.5,0.5s"}) {
    const std::string refused = choice_refusal({"model", delay, "", "", ""});
    EXPECT_NE(refused.find(std::string("--delay: '") + delay + "'"), std::string::npos) << delay;
    EXPECT_NE(refused.find("0 to 2"), std::string::npos) << delay;
  }
  EXPECT_EQ(choice_refusal({"model", "2,0", "", "", ""}), "");
}

}  // namespace
}  // namespace liana::launcher
