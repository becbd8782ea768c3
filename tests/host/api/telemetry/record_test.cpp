// States as records and facts.
#include "host/api/telemetry/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/base/json/json.hpp"

namespace liana::telemetry {
namespace {

Json cable_state() {
  return Json::parse(R"({"op":"state","tick":1505,"time_s":6.02,"state":"ENABLED","events":[{"tick":1,"text":"x"}],
    "measured_js_deg":[1.5,-2.25],"setpoint_js_deg":[1,2],"measured_cp":[1,2,3,1,0,0,0],
    "node_m":[[0.5,0.25,0],[1,0,0]],"tension_N":[40.5,46,45],
    "drives":[{"node":1,"position_m":0.5,"tension_N":40.5,"state":"operation_enabled"},
              {"node":2,"position_m":-0.25,"tension_N":46,"state":"operation_enabled"},
              {"node":3,"position_m":0.125,"tension_N":45,"state":"operation_enabled"}],
    "clearance":null,"path":null,"overruns":3,
    "verdict":{"code":0,"sequence":17,"share":0.5,"twin_js_deg":[],"text":""}})");
}

const Place& place(const Layout& layout, std::string_view name) {
  const auto found = std::find_if(layout.places.begin(), layout.places.end(),
                                  [&](const Place& each) { return each.field.path == name; });
  if (found == layout.places.end()) throw JsonError(std::string(name) + " is not in the layout");
  return *found;
}

TEST(Layout, HasAPlaceForEveryNumberOfTheStateWithoutGaps) {
  const Layout layout = layout_of(cable_state());
  std::size_t offset = kHeaderBytes;
  for (const Place& each : layout.places) {
    EXPECT_EQ(each.offset, offset) << each.field.path;
    offset += 4 * each.count;
  }
  EXPECT_EQ(layout.bytes, offset);
  EXPECT_EQ(place(layout, "node_m").count, 6u);
  EXPECT_EQ(place(layout, "drives.position_m").count, 3u);
}

TEST(Layout, KeepsPlacesForWhatIsNullNowAndLeavesOutWhatTheArmDoesNotHave) {
  const Layout layout = layout_of(cable_state());
  EXPECT_EQ(place(layout, "clearance.where_m").count, 3u);
  EXPECT_EQ(place(layout, "verdict.twin_js_deg").count, 2u);
  EXPECT_THROW(place(layout, "torque_Nm"), JsonError);
  EXPECT_THROW(place(layout, "drives.position_deg"), JsonError);
  EXPECT_EQ(to_json(layout)["fields"].size(), layout.places.size());
  EXPECT_EQ(to_json(layout)["bytes"], layout.bytes);
}

TEST(Layout, IsReadBackAndRefusedWhenItsPlacesAreNotWithinARecord) {
  const Layout layout = layout_of(cable_state());
  Json json = to_json(layout);
  EXPECT_EQ(to_json(layout_from(json)), json);
  json["fields"][0]["count"] = layout.bytes;
  EXPECT_THROW(layout_from(json), JsonError);
  json = to_json(layout);
  json["fields"][1]["name"] = "unheard_of";
  EXPECT_THROW(layout_from(json), JsonError);
  json = to_json(layout);
  json["version"] = 2;
  EXPECT_THROW(layout_from(json), JsonError);
}

TEST(Record, HoldsHeaderAndNumbersAndNaNForWhatIsNotThere) {
  const Layout layout = layout_of(cable_state());
  const std::string record = encode(layout, cable_state(), 7, 3);
  ASSERT_EQ(record.size(), layout.bytes);
  const Header header = header_of(record);
  EXPECT_EQ(header.sequence, 7u);
  EXPECT_EQ(header.facts, 3u);
  EXPECT_EQ(header.tick, 1505.0);
  EXPECT_EQ(header.time_s, 6.02);
  EXPECT_EQ(value_of(record, place(layout, "measured_js_deg"), 1), -2.25f);
  EXPECT_EQ(value_of(record, place(layout, "node_m"), 3), 1.0f);
  EXPECT_EQ(value_of(record, place(layout, "drives.position_m"), 2), 0.125f);
  EXPECT_EQ(value_of(record, place(layout, "overruns"), 0), 3.0f);
  EXPECT_TRUE(std::isnan(value_of(record, place(layout, "clearance.distance_m"), 0)));
  EXPECT_TRUE(std::isnan(value_of(record, place(layout, "verdict.twin_js_deg"), 1)));
}

TEST(Record, KeepsItsSizeWhenAStateHasMoreOrFewerValuesThanTheLayout) {
  const Layout layout = layout_of(cable_state());
  Json other = cable_state();
  other["tension_N"] = {1, 2, 3, 4, 5};
  other["node_m"] = Json::array();
  const std::string record = encode(layout, other, 1, 1);
  ASSERT_EQ(record.size(), layout.bytes);
  EXPECT_EQ(value_of(record, place(layout, "tension_N"), 2), 3.0f);
  EXPECT_EQ(value_of(record, place(layout, "drives.position_m"), 0), 0.5f);
  EXPECT_TRUE(std::isnan(value_of(record, place(layout, "node_m"), 0)));
}

// As a serial arm with a wrist sensor says it, before its first push.
Json pushing_state() {
  return Json::parse(R"({"op":"state","tick":5,"time_s":0.02,"measured_js_deg":[1],"torque_commanded_Nm":[2.5],
    "insert":{"number":0,"phase":"none","force_setpoint_N":null,"applied_force":null,
            "measured_wrench":{"force_N":[0.5,0,-20],"torque_Nm":[0,3,4]},"wrist":"good","wrist_age_s":0}})");
}

TEST(Record, HoldsNumbersOfAMemberOfAMember) {
  const Layout layout = layout_of(pushing_state());
  const std::string record = encode(layout, pushing_state(), 1, 1);
  EXPECT_EQ(value_of(record, place(layout, "insert.measured_wrench.force_N"), 2), -20.0f);
  EXPECT_EQ(value_of(record, place(layout, "torque_commanded_Nm"), 0), 2.5f);
  EXPECT_TRUE(std::isnan(value_of(record, place(layout, "insert.applied_force.force_N"), 0)));
  EXPECT_TRUE(std::isnan(value_of(record, place(layout, "insert.force_setpoint_N"), 0)));
  EXPECT_THROW(place(layout_of(cable_state()), "insert.force_setpoint_N"), JsonError);
}

TEST(Facts, HoldNoNumbersOfAMemberOfAMember) {
  Json later = pushing_state();
  later["insert"]["measured_wrench"]["force_N"] = {1, 2, 3};
  later["insert"]["wrist_age_s"] = 0.004;
  EXPECT_EQ(facts_of(later), facts_of(pushing_state()));
  EXPECT_EQ(facts_of(later)["insert"],
            Json::parse(R"({"number":0,"phase":"none","applied_force":null,"measured_wrench":{},"wrist":"good"})"));
}

TEST(Facts, AreTheSameWhileOnlyNumbersChange) {
  Json later = cable_state();
  later["tick"] = 1510;
  later["measured_js_deg"] = {3, 4};
  later["verdict"]["sequence"] = 18;
  later["drives"][0]["tension_N"] = 41;
  EXPECT_EQ(facts_of(later), facts_of(cable_state()));
  EXPECT_EQ(facts_of(later)["drives"][0], Json::parse(R"({"node":1,"state":"operation_enabled"})"));
}

TEST(Facts, TellOfAVerdictOnlyWhenItRefused) {
  Json refused = cable_state();
  EXPECT_FALSE(facts_of(refused).contains("verdict"));
  refused["verdict"]["code"] = 104;
  refused["verdict"]["text"] = "too fast";
  EXPECT_EQ(facts_of(refused)["verdict"]["text"], "too fast");
}

}  // namespace
}  // namespace liana::telemetry
