// The tool at the tip: when it begins, what it refuses, how it fails (req:A7 req:A53).
#include "hil/arm/tip_tool.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include "tests/message.hpp"

namespace liana::bench {
namespace {

constexpr Vec3 kRod{1.0, 0.0, 0.0};
constexpr Vec3 kAtTheRod{1.0, 0.01, 0.0};

// Phases with their reasons while `tool` acts from 0 to 10 s, one slot every 4 ms.
std::string course(TipTool& tool, const Vec3& tip_m = kAtTheRod) {
  std::string said;
  for (int slot = 0; slot < 2500; ++slot)
    if (const auto report = tool.act(0.004 * slot, tip_m, kRod))
      said += (said.empty() ? "" : ", ") + report->phase + (report->reason.empty() ? "" : ": " + report->reason);
  return said;
}

TEST(TipTool, ARepairTakesThreeSecondsAndTheRodOut) {
  TipTool tool;
  tool.ask({1, "repair", 0.2});
  EXPECT_FALSE(tool.act(0.196, kAtTheRod, kRod)) << "not before it is told to begin";
  EXPECT_EQ(tool.act(0.2, kAtTheRod, kRod)->phase, "acting");
  EXPECT_FALSE(tool.act(3.196, kAtTheRod, kRod));
  EXPECT_FALSE(tool.has_rod());
  EXPECT_EQ(tool.act(3.2, kAtTheRod, kRod)->phase, "done");
  EXPECT_TRUE(tool.has_rod());
  EXPECT_FALSE(tool.act(3.204, kAtTheRod, kRod)) << "what it has said it does not say again";
}

TEST(TipTool, WhatItCannotDoFailsWithItsReason) {
  TipTool far, other, twice;
  far.ask({1, "repair", 0.0});
  EXPECT_TRUE(names(course(far, {1.0, 0.1, 0.0}), {"failed", "rod", "100 mm", "15 mm"}));
  other.ask({1, "drill", 0.0});
  EXPECT_TRUE(names(course(other), {"failed", "repair", "drill"}));
  twice.ask({1, "repair", 0.0});
  EXPECT_EQ(course(twice), "acting, done");
  twice.ask({2, "repair", 0.0});
  EXPECT_TRUE(names(course(twice), {"failed", "rod", "out"}));
}

TEST(TipTool, ARodThatSlipsAwayHalfWayIsNotOut) {
  TipTool tool;
  tool.ask({1, "repair", 0.0});
  EXPECT_EQ(tool.act(0.0, kAtTheRod, kRod)->phase, "acting");
  EXPECT_EQ(tool.act(1.0, {1.0, 0.02, 0.0}, kRod)->phase, "failed");
  EXPECT_FALSE(tool.has_rod());
}

TEST(TipTool, AJammedToolFailsHalfWayAndASilentOneSaysNothing) {
  TipTool jammed, silent;
  jammed.suffer({true, false});
  jammed.ask({1, "repair", 0.0});
  EXPECT_TRUE(names(course(jammed), {"acting", "failed", "jammed"}));
  EXPECT_FALSE(jammed.has_rod());
  silent.suffer({false, true});
  silent.ask({1, "repair", 0.0});
  EXPECT_EQ(course(silent), "");
}

TEST(TipTool, HearsItsOwnMessagesOnly) {
  const auto heard = tool_command(R"({"op":"tool","number":3,"command":"repair","begin_s":1.5})");
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->number, 3);
  EXPECT_EQ(heard->begin_s, 1.5);
  EXPECT_FALSE(tool_command(R"({"op":"ok","id":3})"));
  EXPECT_FALSE(tool_command("[]"));
  EXPECT_FALSE(tool_command("no JSON"));
  const auto said = nlohmann::json::parse(tool_message({3, "failed", "jammed", 2.5}));
  EXPECT_EQ(said.at("op"), "tool_report");
  EXPECT_EQ(said.at("reason"), "jammed");
}

}  // namespace
}  // namespace liana::bench
