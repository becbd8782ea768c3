// The dictionary is whole and without contradiction, and its values come back as they were.
#include "host/api/ground/dictionary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "host/api/server/request_table.hpp"
#include "host/base/event/event.hpp"
#include "host/base/json/json.hpp"

namespace liana::ground {
namespace {

constexpr Sizes kSizes{10, 15};

std::string encoded(const CommandRow& row, const Json& values) {
  std::string out;
  for (const Parameter& each : arguments_of(row)) append_value(out, each, kSizes, values.member_or_null(each.name));
  return out;
}

const CommandRow& command(const char* name) {
  for (const CommandRow& row : commands()) {
    if (std::string_view(row.name) == name) return row;
  }
  throw std::runtime_error(name);
}

TEST(Dictionary, NamesEachPacketOnceAndKnowsItByItsHeader) {
  std::set<std::string> names;
  for (const ReportRow& row : reports()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    Telemetry packet;
    const bool is_time = row.service == 9;
    packet.primary = {0, false, !is_time, is_time ? kTimeApid : kArmApid, 3, 0, 1};
    packet.service = row.service;
    packet.subtype = row.subtype;
    packet.data = record_of(row, kSizes, Json());
    EXPECT_EQ(find_report(packet), &row) << row.name;
    EXPECT_LE(telemetry_bytes(packet).size(), kMaxPacketBytes) << row.name;
  }
  names.clear();
  for (const CommandRow& row : commands()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(find_command(row.service, row.subtype, row.function), &row) << row.name;
  }
}

TEST(Dictionary, NamesEveryParameterOfAPacketOnce) {
  for (const ReportRow& row : reports()) {
    std::set<std::string> names;
    for (const Parameter& each : row.parameters) EXPECT_TRUE(names.insert(each.name).second) << row.name << each.name;
  }
}

TEST(Dictionary, TakesEveryFunctionFromTheTableOfRequests) {
  for (const CommandRow& row : commands()) {
    EXPECT_EQ(row.service == 8, *row.op != '\0') << row.name;
    if (row.service != 8) continue;
    const api::RequestRow* request = api::find_request(row.op);
    ASSERT_NE(request, nullptr) << row.name;
    EXPECT_NE(request->roles & api::only(api::Role::kClient), 0) << row.name;
    std::set<std::string> given(row.fields.begin(), row.fields.end());
    if (*row.command != '\0') given.insert("command");
    for (const api::RequestField& field : request->fields) {
      EXPECT_TRUE(field.need != api::Need::kRequired || given.contains(field.name)) << row.name << field.name;
      given.erase(field.name);
    }
    EXPECT_TRUE(given.empty()) << row.name << ": " << *given.begin();
  }
}

TEST(Dictionary, HasADefinitionForEveryKindOfEvent) {
  std::set<std::uint16_t> definitions;
  for (std::size_t i = 0; i < event::kEventKinds; ++i) {
    const char* name = event::event_kind_name(static_cast<event::EventKind>(i));
    EXPECT_TRUE(definitions.insert(definition_of(name)).second) << name;
    EXPECT_GE(severity_of(name, 0), 1);
    EXPECT_LE(severity_of(name, 0), 4);
  }
  EXPECT_FALSE(definitions.contains(0));
  EXPECT_EQ(definition_of("no such kind"), 0);
}

TEST(Dictionary, SaysWhatEachOfItsFailureCodesMeans) {
  std::set<Failure> known;
  for (const Failure each : own_failures()) {
    EXPECT_FALSE(meaning_of(each).empty());
    EXPECT_TRUE(known.insert(each).second);
  }
}

TEST(Values, OfAJointMoveComeBackAsTheRequest) {
  Json goal = Json::array();
  for (int i = 0; i < 10; ++i) goal.push_back(-8.5 + 0.1 * i);
  const CommandRow& row = command("move_jp");
  const Json request = request_of(row, kSizes, encoded(row, {{"goal_deg", goal}, {"rate_deg_s", 0.5}}));
  EXPECT_EQ(request, (Json{{"op", "move_jp"}, {"goal_deg", goal}, {"rate_deg_s", 0.5}}));
}

TEST(Values, ThatMayBeLeftOutAreLeftOutWhereTheirOctetsAreZero) {
  const CommandRow& row = command("move_jp");
  const std::string zeros(bytes_of(arguments_of(row), kSizes), '\0');
  const Json request = request_of(row, kSizes, zeros);
  EXPECT_TRUE(request.contains("goal_deg"));
  EXPECT_FALSE(request.contains("rate_deg_s"));
}

TEST(Values, HaveTheFixedCommandOfTheirFunction) {
  EXPECT_EQ(request_of(command("enable"), kSizes, ""), (Json{{"op", "state_command"}, {"command", "enable"}}));
}

TEST(Values, OfAnotherLengthOrMeaningAreRefused) {
  const CommandRow& move = command("move_jp");
  EXPECT_THROW(request_of(move, kSizes, ""), JsonError);
  EXPECT_THROW(request_of(move, kSizes, std::string(bytes_of(arguments_of(move), kSizes) + 1, '\0')), JsonError);
  const CommandRow& mission = command("mission");
  EXPECT_EQ(request_of(mission, kSizes, std::string(1, '\4')).at("command"), "abort");
  EXPECT_THROW(request_of(mission, kSizes, std::string(1, '\5')), JsonError);
  const CommandRow& tool = command("tool");
  EXPECT_THROW(request_of(tool, kSizes, std::string(64, '\xff')), JsonError);
}

TEST(Values, ThatAreNotKnownAreLeftOut) {
  for (const ReportRow& row : reports()) {
    std::string record = record_of(row, kSizes, Json());
    if (row.structure != kNoStructure) record.erase(0, 1);
    const Json values = values_of(row.parameters, kSizes, record);
    for (const auto& [name, value] : values.items())
      EXPECT_TRUE(name == "emergency_stop" || name == "time") << row.name << name;
  }
}

TEST(Values, AtTheEndsOfTheirRangesComeBack) {
  const Parameter whole{"whole", ValueType::kWhole, 2}, real{"real", ValueType::kReal, 8};
  const Parameter text{"text", ValueType::kText, 4};
  const auto back = [](const Parameter& parameter, const Json& value) {
    std::string bytes;
    append_value(bytes, parameter, kSizes, value);
    return values_of({&parameter, 1}, kSizes, bytes).member_or_null(parameter.name);
  };
  EXPECT_EQ(back(whole, 0), 0);
  EXPECT_EQ(back(whole, 65534), 65534);
  EXPECT_EQ(back(whole, 65535), 65534);  // all bits 1 are kept for what is not known
  EXPECT_EQ(back(whole, 1e300), 65534);
  EXPECT_TRUE(back(whole, -1).is_null());
  EXPECT_TRUE(back(whole, "1").is_null());
  for (const double value : {0.0, -0.0, 5e-324, -1.7976931348623157e308, 0.1})
    EXPECT_EQ(back(real, value).get<double>(), value);
  EXPECT_TRUE(back(real, std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_EQ(back(text, "abcd"), "abcd");
  EXPECT_EQ(back(text, "abcde"), "abcd");
  EXPECT_EQ(back(text, "abc\xc3\xa4"), "abc");  // no half of a character
}

TEST(Values, OfHousekeepingAreThoseOfTheState) {
  const Json state{{"tick", 7},
                   {"time_s", 0.028},
                   {"state", "FAULT"},
                   {"is_homed", true},
                   {"stop", nullptr},
                   {"faults", Json::array({Json{{"number", 3002}}, Json{{"number", 4001}}})},
                   {"verdict", {{"code", 208}, {"share", 1.5}}},
                   {"owner", "mission"}};
  Json values =
      values_of(find_structure(1)->parameters, kSizes, record_of(*find_structure(1), kSizes, state).substr(1));
  EXPECT_EQ(values.at("tick"), 7);
  EXPECT_EQ(values.at("state"), "FAULT");
  EXPECT_EQ(values.at("is_homed"), true);
  EXPECT_EQ(values.at("emergency_stop"), false);
  EXPECT_EQ(values.at("faults"), 2);
  EXPECT_EQ(values.at("first_fault"), 3002);
  EXPECT_EQ(values.at("verdict_code"), 208);
  EXPECT_EQ(values.at("owner"), "mission");
  EXPECT_FALSE(values.contains("is_busy"));
}

}  // namespace
}  // namespace liana::ground
