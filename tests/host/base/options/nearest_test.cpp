// Which name somebody meant.
#include "host/base/options/nearest.hpp"

#include <gtest/gtest.h>

namespace liana::options {
namespace {

const std::vector<std::string> kNames = {"status", "estop",  "replay", "reach",  "run",
                                         "ik",     "--json", "--to",   "zhu2022"};

TEST(Nearest, FindsANameThatIsTwoEditsAway) {
  EXPECT_EQ(nearest("statsu", kNames), "status") << "two letters exchanged";
  EXPECT_EQ(nearest("stattus", kNames), "status") << "one added";
  EXPECT_EQ(nearest("stts", kNames), "status") << "two left out";
  EXPECT_EQ(nearest("ruplay", kNames), "replay") << "one replaced";
  EXPECT_EQ(nearest("zhu202", kNames), "zhu2022");
  EXPECT_EQ(nearest("--jsn", kNames), "--json");
  EXPECT_EQ(nearest("ki", kNames), "ik");
}

TEST(Nearest, FindsNothingFartherAway) {
  for (const char* far : {"", "-", "--", "x", "xx", "sta", "statusses", "nosuch", "--by", "zhu", "iii"})
    EXPECT_EQ(nearest(far, kNames), "") << far;
  EXPECT_EQ(nearest("status", {}), "");
}

TEST(Nearest, TakesTheNearestAndTheFirstOfSeveral) {
  EXPECT_EQ(nearest("robot_a", {"robot_bb", "robot_b", "robot_c"}), "robot_b");
}

TEST(Nearest, WhatIsSaidNamesItAndIsNothingWhereNoneIsNear) {
  EXPECT_NE(did_you_mean("statsu", kNames).find("status"), std::string::npos);
  EXPECT_EQ(did_you_mean("nosuch", kNames), "");
  EXPECT_NE(did_you_mean("human", {"recorded", "model"}).find("called model now"), std::string::npos);
  EXPECT_NE(did_you_mean("fixture_a", {"jig_a", "jig_b"}).find("called jig_a now"), std::string::npos);
}

TEST(Nearest, TheListOfAllowedNamesEndsWithTheNearest) {
  const std::vector<std::string> poses{"fold", "zero"};
  EXPECT_EQ(allowed_names("zeor", poses, ", or more"), "fold, zero, or more" + did_you_mean("zeor", poses));
}

}  // namespace
}  // namespace liana::options
