#include "host/base/event/fault_groups.hpp"

#include <algorithm>

#include "host/base/json/json.hpp"

namespace liana::event {
namespace {

constexpr std::size_t kMaxWhole = 3;
constexpr std::string_view kDrive = "drive ";

// "a, b and c"
std::string listed(const std::vector<std::string>& texts) {
  std::string out;
  for (std::size_t i = 0; i < texts.size(); ++i)
    out += (i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ") + texts[i];
  return out;
}

// Where in `groups` this fault is now.
std::size_t add_to(std::vector<FaultGroup>& groups, const Json& fault) {
  const FaultGroup one{.number = fault.value("number", 0),
                       .name = fault.value("name", ""),
                       .detail = fault.value("detail", 0),
                       .places = {},
                       .text = fault.value("text", ""),
                       .remedy = fault.value("remedy", ""),
                       .follows = {}};
  auto group = std::find_if(groups.begin(), groups.end(), [&](const FaultGroup& other) {
    return other.number == one.number && other.detail == one.detail && other.text == one.text;
  });
  if (group == groups.end()) group = groups.insert(groups.end(), one);
  if (const std::string where = fault.value("where", ""); !where.empty()) group->places.push_back(where);
  return static_cast<std::size_t>(group - groups.begin());
}

}  // namespace

std::string places_text(const std::vector<std::string>& places) {
  const auto is_drive = [](const std::string& place) { return place.starts_with(kDrive); };
  if (places.size() < 2 || !std::all_of(places.begin(), places.end(), is_drive)) return listed(places);
  std::vector<std::string> numbers;
  for (const std::string& place : places) {
    const std::string name = place.substr(kDrive.size());
    numbers.push_back(places.size() > kMaxWhole ? name.substr(0, name.find(' ')) : name);
  }
  return "drives " + listed(numbers);
}

std::string FaultGroup::title() const {
  return std::to_string(number) + " " + name + (places.empty() ? "" : ": " + places_text(places)) +
         (detail == 0 ? "" : " (detail " + std::to_string(detail) + ")");
}

std::string FaultGroup::alarm() const {
  std::size_t count = 0;
  for (const FaultGroup& one : follows) count += std::max<std::size_t>(1, one.places.size());
  if (count == 0) return title();
  return title() + " and " + std::to_string(count) + (count == 1 ? " consequence" : " consequences");
}

std::vector<FaultGroup> fault_groups(const Json& faults) {
  std::vector<FaultGroup> groups;
  std::vector<std::size_t> group_of(faults.size(), 0);
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const Json cause = faults[i].value("cause", Json());
    const bool follows = cause.is_number() && cause.get<std::size_t>() < i;
    if (follows) group_of[i] = group_of[cause.get<std::size_t>()];
    std::vector<FaultGroup>& into = follows ? groups[group_of[i]].follows : groups;
    const std::size_t place = add_to(into, faults[i]);
    if (!follows) group_of[i] = place;
  }
  return groups;
}

}  // namespace liana::event
