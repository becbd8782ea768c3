// The page of a run.
#include "host/apps/run_page/run_data.hpp"

#include <gtest/gtest.h>

#include "host/api/telemetry/record.hpp"

namespace liana::run_page {
namespace {

Json state_at(int tick) {
  return {{"tick", tick},  {"time_s", 0.004 * tick}, {"measured_js_deg", {1.0, 2.0}},
          {"overruns", 0}, {"state", "ENABLED"},     {"owner", tick < 50 ? "nobody" : "</script><b>"}};
}

RunData short_run() {
  RunData run;
  run.title = "a run";
  run.period_s = 0.004;
  run.layout = telemetry::layout_of(state_at(0));
  for (int tick = 0; tick <= 100; tick += 5) run.records.push_back(telemetry::encode(run.layout, state_at(tick), 1, 1));
  run.facts = {{0, telemetry::facts_of(state_at(0))}, {50, telemetry::facts_of(state_at(50))}};
  run.events = {{{"kind", "step"}, {"number", 1}, {"subject", "approach"}, {"tick", 20}},
                {{"kind", "fault"}, {"number", 3002}, {"subject", "drive 3"}, {"tick", 60}}};
  for (std::uint64_t i = 1; i <= 20; ++i) {
    report::CommandRecord life;
    life.command = i;
    life.tick = 5 * i;
    run.commands.push_back(life);
  }
  run.commands[15].refusal = event::Dispatch{.stage = event::Stage::kRefusal, .tick = 80, .command = 16, .number = 104};
  return run;
}

// The JSON in the page of the run.
Json json_of(const RunData& run) {
  const std::string page = page_of(run, "<body>\n<!-- liana-run -->\n</body>");
  const std::string begin = "id=\"liana-run\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(PageOfARun, StandsWhereTheMarkWasAndNothingInItLooksLikeATag) {
  const std::string page = page_of(short_run(), "<body>\n<!-- liana-run -->\n</body>");
  EXPECT_TRUE(page.starts_with("<body>\n<script type=\"application/json\" id=\"liana-run\">{"));
  EXPECT_TRUE(page.ends_with("</script>\n</body>"));
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_EQ(json_of(short_run())["facts"][1]["state"]["owner"], "</script><b>");
}

TEST(PageOfARun, TellsOfFactsOnlyWhatHasChanged) {
  const Json facts = json_of(short_run())["facts"];
  EXPECT_TRUE(facts[0]["state"].contains("state"));
  EXPECT_FALSE(facts[1]["state"].contains("state"));
  EXPECT_EQ(facts[1]["tick"], 50);
}

TEST(PageOfARun, HasEveryRefusedCommandAndOfTheOthersOneASecond) {
  const Json commands = json_of(short_run())["commands"];
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0]["command"], 1);
  EXPECT_EQ(commands[1]["refusal"]["code"], 104);
}

TEST(PageOfARun, HasStepsEventsAndAColumnForEveryNumber) {
  const Json run = json_of(short_run());
  EXPECT_EQ(run["steps"], Json::parse(R"([{"index":1,"name":"approach","tick":20}])"));
  EXPECT_EQ(run["events"].size(), 2u);
  EXPECT_EQ(run["telemetry"]["rows"], 11);
  EXPECT_EQ(run["telemetry"]["columns"].size(), 3u);
  EXPECT_EQ(run["telemetry"]["columns"][1]["index"], 1);
}

TEST(PageOfARun, IsMadeOfARunThatLeftNothing) {
  RunData run;
  run.period_s = 0.004;
  EXPECT_EQ(json_of(run)["telemetry"]["rows"], 0);
  EXPECT_TRUE(json_of(run)["report"].is_null());
}

TEST(PageOfARun, HoldsItsTicksOnlyWithTheCoreThatReplaysThem) {
  RunData run = short_run();
  run.ticks = {false, 3, 2, "start", "sizes", "inputs", "checksums"};
  EXPECT_TRUE(json_of(run)["replay"].is_null());
  run.core = "core";
  EXPECT_EQ(json_of(run)["replay"], Json::parse(R"({"is_serial":false,"recorded":3,"start_bytes":5,"ticks":2})"));
  run.ticks.ticks = 0;
  EXPECT_TRUE(json_of(run)["replay"].is_null());
}

TEST(PageOfARun, IsRefusedWithoutItsMark) { EXPECT_THROW(page_of(short_run(), "<body></body>"), std::runtime_error); }

}  // namespace
}  // namespace liana::run_page
