// Faults in one line for each kind.
#include "host/base/event/fault_groups.hpp"

#include <gtest/gtest.h>

#include "host/base/json/json.hpp"

namespace liana::event {
namespace {

Json fault(int number, const std::string& where, int detail = 0) {
  return {
      {"number", number}, {"name", "drive_silent"}, {"where", where}, {"detail", detail}, {"text", "It is silent."}};
}

TEST(FaultGroups, DrivesOfOneKindStandInOneLine) {
  const auto groups = fault_groups({fault(3002, "drive 4 (node 4, segment 2)"), fault(4001, "bus can0"),
                                    fault(3002, "drive 5 (node 5, segment 2)")});
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].title(), "3002 drive_silent: drives 4 (node 4, segment 2) and 5 (node 5, segment 2)");
  EXPECT_EQ(groups[1].places, std::vector<std::string>{"bus can0"});
}

TEST(FaultGroups, OtherDetailsStandApart) {
  const auto groups = fault_groups({fault(3003, "drive 1 (node 1)", 16), fault(3003, "drive 2 (node 2)")});
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].title(), "3003 drive_silent: drive 1 (node 1) (detail 16)");
}

TEST(FaultGroups, WhatFollowsFromAFaultIsCountedBelowIt) {
  Json silent = fault(3002, "drive 4 (node 4)"), missing = fault(3001, "drive 4 (node 4)");
  Json stopped = fault(3008, "drive 4 (node 4)"), other = fault(5002, "drive 9 (node 9)");
  silent["cause"] = other["cause"] = nullptr;
  missing["cause"] = 0;
  stopped["cause"] = 1;
  const auto groups = fault_groups({silent, missing, stopped, other});
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].follows.size(), 2U);
  EXPECT_EQ(groups[0].alarm(), "3002 drive_silent: drive 4 (node 4) and 2 consequences");
  EXPECT_EQ(groups[1].alarm(), groups[1].title());
}

TEST(FaultGroups, ManyDrivesAreNumbersOnly) {
  EXPECT_EQ(places_text({"drive 1 (node 1)", "drive 2 (node 2)", "drive 3 (node 3)", "drive 4 (node 4)"}),
            "drives 1, 2, 3 and 4");
  EXPECT_EQ(places_text({"bus can0", "drive 2 (node 2)"}), "bus can0 and drive 2 (node 2)");
  EXPECT_EQ(places_text({}), "");
}

}  // namespace
}  // namespace liana::event
