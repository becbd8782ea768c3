#include "host/storage/archive/facts_change.hpp"

#include "host/base/json/json.hpp"

namespace liana::archive {

std::optional<Json> change_of(const Json& before, const Json& now) {
  for (const auto& [name, value] : before.items()) {
    if (!now.contains(name)) return std::nullopt;
  }
  Json change = Json::object();
  for (const auto& [name, value] : now.items()) {
    const Json* old = before.find(name);
    if (old == nullptr || !(*old == value)) change[name] = value;
  }
  return change;
}

Json with_change(Json before, const Json& change) {
  for (const auto& [name, value] : change.items()) before[name] = value;
  return before;
}

}  // namespace liana::archive
