// One command for the tool at a time, and what it says counts when every run has heard it (req:A7 req:A53).
#include "host/control/server/tip_tool.hpp"

#include <gtest/gtest.h>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "tests/host/api/server/robots.hpp"
#include "tests/message.hpp"

namespace liana::server {
namespace {

class Tool : public testing::Test {
 protected:
  std::string ask(bool is_connected = true) {
    return code_of([&] { tool_.ask("repair", 10.0, is_connected); });
  }
  std::string hear(std::int64_t number, const char* phase, std::uint64_t due_tick, const char* reason = "") {
    Json report{{"op", "tool_report"}, {"number", number}, {"phase", phase}, {"time_s", 10.0}};
    if (*reason != 0) report["reason"] = reason;
    const api::RequestRow& row = api::row_of(report);
    return code_of([&] { tool_.hear(api::checked(row, report, bounds_), due_tick); });
  }
  std::string phase() const { return tool_.json().at("phase").text(); }
  template <class Act>
  static std::string code_of(Act act) {
    try {
      act();
    } catch (const api::RequestError& error) {
      return error.code();
    }
    return "accepted";
  }

  api::RequestBounds bounds_ = api::request_bounds(api::zhu2022_json());
  TipTool tool_;
};

TEST_F(Tool, WithoutOneACommandIsRefused) {
  EXPECT_EQ(ask(false), "no_device");
  EXPECT_EQ(phase(), "none");
}

TEST_F(Tool, TellsWhenToBeginAndWhatBecameOfTheCommandOnceItCounts) {
  EXPECT_NEAR(tool_.ask("repair", 10.0, true).at("begin_s").get<double>(), 10.2, 1e-12);
  EXPECT_EQ(phase(), "asked");
  EXPECT_EQ(ask(), "busy");
  EXPECT_EQ(hear(1, "acting", 100), "accepted");
  EXPECT_EQ(hear(1, "done", 800), "accepted");
  EXPECT_FALSE(tool_.pass(99));
  EXPECT_EQ(phase(), "asked") << "not before it is due";
  EXPECT_FALSE(tool_.pass(100)) << "acting is no end";
  EXPECT_EQ(phase(), "acting");
  const auto ended = tool_.pass(800);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->text, "tool: repair done");
  EXPECT_FALSE(tool_.pass(801));
  EXPECT_EQ(ask(), "accepted") << "the next";
}

TEST_F(Tool, AReportOnAnotherCommandThanTheOneUnderWayIsRefused) {
  EXPECT_EQ(hear(1, "done", 0), "refused") << "none was given";
  ask();
  EXPECT_EQ(hear(2, "done", 0), "refused");
  EXPECT_EQ(hear(1, "failed", 0, "jammed"), "accepted");
  EXPECT_EQ(tool_.pass(0)->text, "tool: repair failed: jammed");
  EXPECT_EQ(hear(1, "done", 0), "refused") << "it has ended";
}

TEST_F(Tool, AToolThatIsGoneHasFailedItsCommand) {
  EXPECT_FALSE(tool_.lose()) << "nothing was under way";
  ask();
  EXPECT_TRUE(names(tool_.lose()->text, {"tool", "repair", "gone"}));
  EXPECT_EQ(phase(), "failed");
}

}  // namespace
}  // namespace liana::server
