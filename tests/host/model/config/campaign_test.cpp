// Tables of campaigns: what they say, and every kind of value that is refused.
#include "host/model/config/campaign.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "host/base/json/json.hpp"

namespace liana::config {
namespace {

Json table() {
  return Json::parse(R"({"format":1,"kind":"campaign","name":"trial","mission":"lab_tour","robot":"three_segment_lab",
    "seeds":{"first":5,"count":10},"options":{"temper":"lively"},
    "sweep":{"delay":["0,0","0.5,0.5"],"robot.tension.plan_N":[20,30,40]},
    "draw":{"gravity":{"uniform":[0,0.1]},"linkage_error":{"normal":[0,0.01],"within":[0,0.05]},
            "true_physics":{"choice":["nominal","worn"]},"scene_offset":[{"uniform":[0,5]},0.5]}})");
}

std::string refusal_of(const char* field, const char* value) {
  Json changed = table();
  changed[field] = Json::parse(value);
  try {
    parse_campaign(changed, "trial.lua");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Campaign, HasARowForEveryPointOfItsSweepAndEverySeed) {
  const CampaignConfig read = parse_campaign(table(), "trial.lua");
  EXPECT_EQ(read.row_count(), 2u * 3u * 10u);
  EXPECT_EQ(read.first_seed, 5u);
  EXPECT_EQ(read.keep_failed, 20u);
  ASSERT_EQ(read.draw.size(), 4u);
  EXPECT_EQ(read.draw[1].key, "linkage_error");
  EXPECT_EQ(read.draw[1].parts.front().high, 0.05);
  EXPECT_EQ(read.draw[2].parts.size(), 2u);
}

TEST(Campaign, RefusesEachFieldThatCannotBeUsedByItsPath) {
  struct Bad {
    const char *field, *value, *said;
  };
  for (const Bad& bad : {Bad{"mision", "1", "mision"},
                         {"mission", "\"plan.json\"", "mission"},
                         {"mission", "7", "mission"},
                         {"seeds", R"({"count":0})", "seeds.count"},
                         {"seeds", R"({"count":1000001})", "seeds.count"},
                         {"seeds", R"({"first":-1,"count":1})", "seeds.first"},
                         {"seeds", R"({"first":0.5,"count":1})", "seeds.first"},
                         {"seeds", R"({"cuont":1})", "seeds.cuont"},
                         {"keep_failed", "-1", "keep_failed"},
                         {"options", "[1]", "options"},
                         {"options", R"({"Temper":"lively"})", "options.Temper"},
                         {"options", R"({"temper":true})", "options.temper"},
                         {"options", R"({"temper":""})", "options.temper"},
                         {"options", R"({"robot.":1})", "options.robot."},
                         {"options", R"({"robot":"micro"})", "robot"},
                         {"sweep", R"({"gravity":[]})", "sweep.gravity"},
                         {"sweep", R"({"gravity":0.1})", "sweep.gravity"},
                         {"sweep", R"({"temper":["gentle"]})", "temper"},
                         {"draw", R"({"delay":{"uniform":[0,1]}})", "delay"},
                         {"draw", R"({"gravity":0.1})", "draw.gravity"},
                         {"draw", R"({"gravity":{"uniform":[1,0]}})", "draw.gravity.uniform"},
                         {"draw", R"({"gravity":{"uniform":[0]}})", "draw.gravity.uniform"},
                         {"draw", R"({"gravity":{"unifrom":[0,1]}})", "draw.gravity.unifrom"},
                         {"draw", R"({"gravity":{"uniform":[0,1],"normal":[0,1]}})", "draw.gravity"},
                         {"draw", R"({"gravity":{"uniform":[0,1],"within":[0,1]}})", "draw.gravity"},
                         {"draw", R"({"gravity":{"normal":[0,0]}})", "draw.gravity.normal"},
                         {"draw", R"({"gravity":{"normal":[0,1],"within":[4,5]}})", "draw.gravity.within"},
                         {"draw", R"({"gravity":{"normal":[0,1],"within":[1,1]}})", "draw.gravity.within"},
                         {"draw", R"({"gravity":{"choice":[]}})", "draw.gravity.choice"},
                         {"draw", R"({"robot.x":[{"uniform":[0,1]},1]})", "draw.robot.x"}}) {
    const std::string said = refusal_of(bad.field, bad.value);
    EXPECT_NE(said.find(bad.said), said.npos) << bad.value << ": " << said;
    EXPECT_EQ(said.find("trial.lua"), 0u) << said;
  }
}

TEST(Campaign, WithoutAMissionOrSeedsIsNone) {
  for (const char* field : {"mission", "seeds", "name", "kind"}) {
    Json without = table();
    without.erase(field);
    EXPECT_THROW(parse_campaign(without, "trial.lua"), std::runtime_error) << field;
  }
}

TEST(Campaign, OfMoreThanAMillionRowsIsRefused) {
  Json large = table();
  large["seeds"] = {{"count", 1'000'000}};
  EXPECT_THROW(parse_campaign(large, "trial.lua"), std::runtime_error);
  large.erase("sweep");
  EXPECT_EQ(parse_campaign(large, "trial.lua").row_count(), kMaxCampaignRows);
}

TEST(Campaign, TakesAnEmptyLuaTableForNothing) {
  Json empty = table();
  for (const char* field : {"options", "sweep", "draw"}) empty[field] = Json::array();
  EXPECT_EQ(parse_campaign(empty, "trial.lua").row_count(), 10u);
}

}  // namespace
}  // namespace liana::config
