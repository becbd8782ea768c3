#include "host/model/config/drive_type.hpp"

#include "host/model/config/drive_types_of_buses.hpp"

#include "tests/host/model/config/tables.hpp"

namespace liana::config {
namespace {

TEST(DriveTypes, TheGenericTableSaysWhatHoldsWithoutAnyTable) {
  EXPECT_EQ(parse_drive_type(good_table("drive", "cia402_csp"), "t"), DriveType{});
}

TEST(DriveTypes, ABusTableGivesEachNodeItsTypeAndCarriesTheTables) {
  Json table = good_table("buses", "embedded");
  EXPECT_FALSE(table.contains("drive_types")) << "a table that names no type stays as it was";
  table["drives"] = {{{"type", "x"}, {"nodes", {3, 9}}}};
  table["drive_types"] = {{"x",
                           {{"format", 1},
                            {"kind", "drive"},
                            {"name", "x"},
                            {"source", "a manual"},
                            {"objects", {{"absent", {"608F:1"}}, {"fixed", {{"6066", 0}}}}}}}};
  const std::map<std::int32_t, DriveType> types = drive_types(parse_buses(table.dump(), "b"));
  ASSERT_EQ(types.size(), 2U);
  EXPECT_EQ(types.at(3), types.at(9));
  EXPECT_EQ(types.at(9).name, "x");
  EXPECT_EQ(types.at(9).rule_of({0x608F, 1}).presence, Presence::kAbsent);
  EXPECT_EQ(types.at(9).rule_of({0x6066, 0}).value, 0U);
  EXPECT_EQ(types.at(9).rule_of({0x6065, 0}).presence, Presence::kOptional);
}

TEST(DriveTypes, AreRefusedWithFileFieldValueRangeAndAdvice) {
  const Json good = good_table("drive", "cia402_csp");
  const auto write = [](const char* object, int bits) {
    return Json::array({Json{{"object", object}, {"name", "n"}, {"bits", bits}, {"value", 1}}});
  };
  const std::vector<Spoiled> cases = {
      {"/kind", "drives", "kind", {"drive"}},
      {"/source", nullptr, "source", {"docs/reference/drives.md"}},
      {"/source", "", "source", {"1", "400"}},
      {"/colour", 1, "colour", {"docs/reference/drives.md"}},
      {"/units/position", -1, "units.position", {"0", "4294967295"}},
      {"/units/speeds", "m/s", "units.speeds", {"increments", "rpm"}},
      {"/units/rated_torque", "Nm", "units.rated_torque", {"mNm", "uNm"}},
      {"/units/gear", Json::array({1}), "units.gear", {"2"}},
      {"/polarity", 1, "polarity", {"64", "128", "192"}},
      {"/times/boot_up_s", 1000, "times.boot_up_s", {"0.05", "120"}},
      {"/stop/within_s", 0, "stop.within_s", {"0.001", "10"}},
      {"/objects", {{"absent", {"1234"}}}, "objects.absent[1]", {"1234"}},
      {"/objects", {{"absent", {"1400:1"}}}, "objects.absent[1]", {"1400:1"}},
      {"/objects", {{"optional", {"0x606"}}}, "objects.optional[1]", {"hexadecimal"}},
      {"/objects", {{"absent", {"6060"}}}, "objects.absent[1]", {"csp"}},
      {"/objects", {{"absent", {"6502"}}}, "objects.absent[1]", {"csp"}},
      {"/objects", {{"absent", {"6040"}}}, "objects.absent[1]", {"csp"}},
      {"/objects", {{"absent", {"6041"}}}, "objects.absent[1]", {"csp"}},
      {"/objects", {{"absent", {"607A"}}}, "objects.absent[1]", {"csp"}},
      {"/objects", {{"optional", {"6064"}}}, "objects.optional[1]", {"csp"}},
      {"/objects", {{"fixed", {{"6060", 1}}}}, "objects.fixed.6060", {"8", "csp"}},
      {"/objects", {{"fixed", {{"6502", 1}}}}, "objects.fixed.6502", {"7"}},
      {"/writes", write("6040", 16), "writes[1].object", {"6040"}},
      {"/objects", {{"optional", {"6065"}}, {"absent", {"6065"}}}, "objects.absent[1]", {"6065"}},
      {"/objects", {{"fixed", {{"6066", "no"}}}}, "objects.fixed.6066", {"0", "4294967295"}},
      {"/dictionary", {{"absent", {"60G5"}}}, "dictionary.absent[1]", {"hexadecimal"}},
      {"/dictionary", {{"missing", {"6065"}}}, "dictionary.missing", {"field"}},
      {"/dictionary", {{"values", {{"6066", 1.5}}}}, "dictionary.values.6066", {"whole"}},
      {"/dictionary", {{"added", Json::array({Json{{"object", "6066"}}})}}, "dictionary.added[1].type", {"missing"}},
      {"/objects", {{"gone", {"6065"}}}, "objects.gone", {"field"}},
      {"/torque", "maybe", "torque", {"6077", "none"}},
      {"/writes", write("6060", 8), "writes[1].object", {"6060"}},
      {"/writes", write("2000:1", 24), "writes[1].bits", {"8", "16", "32"}}};
  for (const Spoiled& spoiled : cases)
    expect_refused(good, spoiled, [](const std::string& text) { parse_drive_type(Json::parse(text), "given.json"); });
}

TEST(DriveTypes, AnIndexMayBeWrittenWith0x) {
  Json table = good_table("drive", "cia402_csp");
  table["objects"] = {{"required", {"0x6065"}}};
  EXPECT_EQ(parse_drive_type(table, "t").rule_of({0x6065, 0}).presence, Presence::kRequired);
}

TEST(DriveTypes, SayWhetherADriveThatLosesItsMasterIsSureToStop) {
  const auto stops = [](const Json& objects) {
    Json table = good_table("drive", "cia402_csp");
    table["objects"] = objects;
    return parse_drive_type(table, "t").stops_by_itself();
  };
  EXPECT_TRUE(DriveType{}.stops_by_itself());
  EXPECT_TRUE(stops({{"absent", {"1400:5"}}}));
  EXPECT_TRUE(stops({{"absent", {"1016:1", "6007"}}, {"required", {"1400:5"}}}));
  EXPECT_FALSE(stops({{"absent", {"1016:1", "1400:5"}}}));
  EXPECT_FALSE(stops({{"absent", {"1016:1"}}})) << "1400:5 may be missing";
  EXPECT_FALSE(stops({{"fixed", {{"1016:1", 0}}}}));
  EXPECT_FALSE(stops({{"fixed", {{"6007", 0}}}}));
}

TEST(DriveTypes, ABusTableThatNamesThemWronglyIsRefused) {
  Json good = good_table("buses", "embedded");
  good["drive_types"] = {{"cia402_csp", good_table("drive", "cia402_csp")}};
  const auto drives = [](const char* type, std::vector<int> nodes) {
    return Json::array({Json{{"type", type}, {"nodes", nodes}}});
  };
  const std::vector<Spoiled> cases = {{"/drives", drives("other", {1}), "drives[1].type", {"drive_types"}},
                                      {"/drives", drives("cia402_csp", {16}), "drives[1].nodes[1]", {"16"}},
                                      {"/drives", drives("cia402_csp", {3, 3}), "drives[1].nodes[2]", {"3"}},
                                      {"/drives", drives("cia402_csp", {}), "drives[1].nodes", {"1", "32"}}};
  for (const Spoiled& spoiled : cases)
    expect_refused(good, spoiled, [](const std::string& text) { parse_buses(text, "given.json"); });
}

}  // namespace
}  // namespace liana::config
