#include "host/base/event/event_json.hpp"

#include <cmath>
#include <limits>

#include "host/base/json/json.hpp"

namespace liana::event {

const char* const kEventSchema = R"({"$schema":"https://json-schema.org/draft/2020-12/schema","title":"event",
"description":"why something happened, once; docs/reference/formats.md, Events",
"type":"object","additionalProperties":false,
"required":["op","sequence","tick","kind","number","subject","values","text"],"properties":{
"op":{"type":"string","enum":["event"]},
"sequence":{"type":"integer","minimum":1,"description":"without gaps"},
"tick":{"type":"integer","minimum":0},
"kind":{"type":"string","enum":["boot","boot_problem","homing","fault","emergency","clear","host_warning","client",
"owner","step","operator","device","tool","refusal","verdict","path","retract","friction","load_cell",
"stop","shutdown","left_out"]},
"number":{"type":"integer","description":"fault, M_e, emergency code, stop category or what else the kind numbers"},
"subject":{"type":"string","description":"drive, bus, client, step or what else it is about"},
"values":{"type":"object","additionalProperties":{"type":["number","null"]}},
"text":{"type":"string"}}})";

Json event_json(const Event& event) {
  Json values = Json::object();
  for (const EventValue& each : event.values) values[each.name] = std::isfinite(each.value) ? Json(each.value) : Json();
  return {{"op", "event"},          {"sequence", event.sequence},
          {"tick", event.tick},     {"kind", event_kind_name(event.kind)},
          {"number", event.number}, {"subject", event.subject},
          {"values", values},       {"text", event.text}};
}

Event event_from_json(const Json& json) {
  const std::string name = json.at("kind").text();
  const auto kind = event_kind_from(name);
  if (!kind) throw JsonError("event: kind '" + name + "' is none of the list in docs/reference/formats.md");
  Event event;
  event.kind = *kind;
  event.number = json.at("number").get<std::int64_t>();
  event.subject = json.at("subject").text();
  for (const auto& [value_name, value] : json.at("values").items()) {
    const double number = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    event.values.push_back({value_name, number});
  }
  event.text = json.at("text").text();
  event.sequence = json.at("sequence").get<std::uint64_t>();
  event.tick = json.at("tick").get<std::uint64_t>();
  return event;
}

}  // namespace liana::event
