#include "host/bus/fault_script.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace liana {
namespace {

// One entry of the script and how messages call it.
struct Entry {
  const nlohmann::json& json;
  std::string where;

  [[noreturn]] void refuse(const std::string& field, const std::string& allowed) const {
    const std::string found = json.contains(field) ? json.at(field).dump() : "missing";
    throw std::runtime_error(where + field + ": " + found + ": allowed " + allowed);
  }

  std::uint64_t number(const std::string& field, std::uint64_t most) const {
    if (!json.contains(field) || !json.at(field).is_number_unsigned() || json.at(field).get<std::uint64_t>() > most) {
      refuse(field, "is a whole number 0 to " + std::to_string(most));
    }
    return json.at(field).get<std::uint64_t>();
  }
};

std::optional<std::uint32_t> read_id(const Entry& entry) {
  if (!entry.json.contains("id")) return std::nullopt;
  const auto& id = entry.json.at("id");
  if (id.is_number_unsigned()) return static_cast<std::uint32_t>(entry.number("id", 0x1FFFFFFF));
  std::size_t used = 0;
  unsigned long value = 0;
  const std::string text = id.is_string() ? id.get<std::string>() : "";
  try {
    value = std::stoul(text, &used, 0);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || value > 0x1FFFFFFF) entry.refuse("id", "is a CAN identifier like \"0x181\"");
  return static_cast<std::uint32_t>(value);
}

DropRule read_rule(const Entry& entry, int bus_count) {
  if (!entry.json.is_object()) throw std::runtime_error(entry.where + " is not an object; write {\"bus\":0,\"id\":\"0x181\",...}");
  for (const auto& [key, value] : entry.json.items()) {
    if (key != "bus" && key != "id" && key != "from_slot" && key != "to_slot" && key != "action") {
      entry.refuse(key, "are only bus, id, from_slot, to_slot and action");
    }
  }
  if (entry.json.value("action", "") != "drop") entry.refuse("action", "is \"drop\"");
  constexpr std::uint64_t kLastSlot = UINT32_MAX;
  DropRule rule{static_cast<int>(entry.number("bus", static_cast<std::uint64_t>(bus_count - 1))), read_id(entry),
                entry.number("from_slot", kLastSlot), entry.number("to_slot", kLastSlot)};
  if (rule.to_slot < rule.from_slot) entry.refuse("to_slot", "is from_slot or later");
  return rule;
}

}  // namespace

FaultScript load_fault_script(const std::string& path, int bus_count) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read; give the fault script of --script");
  const nlohmann::json script = nlohmann::json::parse(file, nullptr, false);
  if (!script.is_array()) throw std::runtime_error(path + ": is not a JSON array of faults (docs/bus-protocol.md)");
  std::vector<DropRule> rules;
  for (std::size_t i = 0; i < script.size(); ++i)
    rules.push_back(read_rule({script[i], path + ": [" + std::to_string(i) + "]."}, bus_count));
  return FaultScript(std::move(rules));
}

}  // namespace liana
