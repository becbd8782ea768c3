#include "host/api/telemetry/layout.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "host/api/telemetry/record.hpp"
#include "host/base/json/json.hpp"

namespace liana::telemetry {
namespace {

constexpr int kVersion = 1;

std::size_t numbers_in(const Json& list) {
  std::size_t count = 0;
  for (const Json& each : list) count += each.is_array() ? each.size() : 1;
  return count;
}

std::size_t entries_with(const Json& list, std::string_view member) {
  return !list.empty() && list.front().contains(member) ? list.size() : 0;
}

// How many values it has in states of this arm; 0: the arm does not have it.
std::size_t count_of(const Json& state, const Field& field) {
  const std::size_t dot = field.path.find('.');
  const Json* member = state.find(field.path.substr(0, dot));
  if (member == nullptr) return 0;
  switch (field.shape) {
    case Shape::kOne:
      return 1;
    case Shape::kThree:
      return 3;
    case Shape::kFive:
      return 5;
    case Shape::kPose:
      return 7;
    case Shape::kJoints:
      return state.at("measured_js_deg").size();
    case Shape::kFound:
      return numbers_in(*member);
    case Shape::kEach:
      return entries_with(*member, field.path.substr(dot + 1));
  }
  return 0;
}

Place place_from(const Json& json, std::size_t bytes) {
  const std::string name = json.at("name");
  const auto field = std::find_if(kFields.begin(), kFields.end(), [&](const Field& each) { return each.path == name; });
  if (field == kFields.end()) throw JsonError("layout: field " + name + " is not known to this version");
  const Place place{*field, json.at("offset"), json.at("count")};
  if (place.offset < kHeaderBytes || place.offset > bytes || place.count > (bytes - place.offset) / sizeof(float))
    throw JsonError("layout: field " + name + " is not within a record of " + std::to_string(bytes) + " bytes");
  return place;
}

}  // namespace

Layout layout_of(const Json& state) {
  Layout layout;
  layout.bytes = kHeaderBytes;
  for (const Field& field : kFields) {
    const std::size_t count = count_of(state, field);
    if (count == 0) continue;
    layout.places.push_back({field, layout.bytes, count});
    layout.bytes += count * sizeof(float);
  }
  return layout;
}

Json to_json(const Layout& layout) {
  Json fields = Json::array();
  for (const Place& place : layout.places) {
    fields.push_back(
        {{"name", place.field.path}, {"unit", place.field.unit}, {"offset", place.offset}, {"count", place.count}});
  }
  return {{"version", kVersion}, {"bytes", layout.bytes}, {"fields", fields}};
}

Layout layout_from(const Json& json) {
  if (json.at("version") != kVersion)
    throw JsonError("layout: version " + json.at("version").dump() + ": allowed " + std::to_string(kVersion));
  Layout layout;
  layout.bytes = json.at("bytes");
  for (const Json& field : json.at("fields")) layout.places.push_back(place_from(field, layout.bytes));
  return layout;
}

}  // namespace liana::telemetry
