// Events as JSON, and the schema that says what they hold.
#include "host/base/event/event_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/base/json/json.hpp"

namespace liana::event {
namespace {

Event example(EventKind kind) {
  return {.kind = kind,
          .number = 3002,
          .subject = "drive 3",
          .values = {{"detail", 7.0}, {"tick", 1233.0}},
          .text = "\"a\" \xC3\xA4",
          .sequence = 5,
          .tick = 1234};
}

// Whether the value is of the type that the schema asks for, which may be a list of types.
bool has_type(const Json& value, const Json& type) {
  if (type.is_array()) return has_type(value, type[0]) || has_type(value, type[1]);
  const std::string name = type.text();
  return (name == "object" && value.is_object()) || (name == "integer" && value.is_number_integer()) ||
         (name == "number" && value.is_number()) || (name == "string" && value.is_string()) ||
         (name == "null" && value.is_null());
}

// What of `event` the schema does not allow; empty when it is valid. Of JSON Schema: the words that kEventSchema uses.
std::string violation(const Json& event, const Json& schema) {
  for (const Json& name : schema["required"]) {
    if (!event.contains(name.text())) return name.text() + " is missing";
  }
  for (const auto& [name, value] : event.items()) {
    const Json& field = schema["properties"].member_or_null(name);
    if (field.is_null()) return name + " is not in the schema";
    if (!has_type(value, field.at("type"))) return name + " has the wrong type";
    if (field.contains("minimum") && value.get<double>() < field.at("minimum").get<double>())
      return name + " is too low";
    if (!field.contains("enum")) continue;
    bool found = false;
    for (const Json& allowed : field.at("enum")) found = found || allowed == value;
    if (!found) return name + " is none of the list";
  }
  for (const auto& [name, value] : event["values"].items()) {
    const Json& field = schema["properties"]["values"]["additionalProperties"];
    if (!has_type(value, field["type"])) return "value " + name + " has the wrong type";
  }
  return "";
}

TEST(EventJson, AnEventOfEveryKindComesBackAsItWas) {
  for (std::size_t k = 0; k < kEventKinds; ++k) {
    const Event event = example(static_cast<EventKind>(k));
    EXPECT_EQ(event_from_json(Json::parse(event_json(event).dump())), event) << event_kind_name(event.kind);
  }
}

TEST(EventJson, AnEventOfEveryKindIsValidAgainstTheSchema) {
  const Json schema = Json::parse(kEventSchema);
  for (std::size_t k = 0; k < kEventKinds; ++k)
    EXPECT_EQ(violation(event_json(example(static_cast<EventKind>(k))), schema), "");
  EXPECT_EQ(schema["properties"]["kind"]["enum"].size(), kEventKinds);
}

TEST(EventJson, TheSchemaAllowsNothingElse) {
  const Json schema = Json::parse(kEventSchema), good = event_json(example(EventKind::kFault));
  for (const char* name : {"op", "sequence", "tick", "kind", "number", "subject", "values", "text"}) {
    Json without = good;
    without.erase(name);
    EXPECT_NE(violation(without, schema), "") << name;
    EXPECT_TRUE(name == std::string("op") || [&] {
      try {
        event_from_json(without);
        return false;
      } catch (const JsonError&) {
        return true;
      }
    }()) << name;
  }
  const std::vector<std::pair<const char*, Json>> wrong{{"kind", "weather"}, {"sequence", 0},          {"number", 1.5},
                                                        {"subject", 3},      {"values", {{"a", "b"}}}, {"more", 1}};
  for (const auto& [name, value] : wrong) {
    Json changed = good;
    changed[name] = value;
    EXPECT_NE(violation(changed, schema), "") << name;
  }
}

TEST(EventJson, AValueThatIsNotFiniteIsNull) {
  Event event = example(EventKind::kVerdict);
  event.values = {{"margin", std::numeric_limits<double>::infinity()}};
  const Json json = event_json(event);
  EXPECT_EQ(json["values"].dump(), R"({"margin":null})");
  EXPECT_EQ(violation(json, Json::parse(kEventSchema)), "");
  EXPECT_TRUE(std::isnan(event_from_json(json).values[0].value));
}

TEST(EventJson, AKindWithoutANameIsRefusedByItsName) {
  Json json = event_json(example(EventKind::kStop));
  json["kind"] = "weather";
  try {
    event_from_json(json);
    FAIL() << "not refused";
  } catch (const JsonError& error) {
    EXPECT_NE(std::string(error.what()).find("'weather'"), std::string::npos);
  }
}

}  // namespace
}  // namespace liana::event
