#include "host/drives/bus_simulator/fault_script.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "host/base/file/in_file.hpp"
#include "host/drives/bus_simulator/json_file.hpp"

namespace liana::bus_simulator {
namespace {

bool covers(const BusFault& fault, std::uint64_t slot) { return slot >= fault.from_slot && slot <= fault.to_slot; }

// What an action is called, and the fields it takes besides action, from_slot and to_slot.
struct ActionFields {
  std::string_view name;
  BusAction action;
  std::string_view fields;
};

constexpr std::array<ActionFields, 11> kActions{{{"drop", BusAction::kDrop, "bus id count"},
                                                 {"duplicate", BusAction::kDuplicate, "bus id count"},
                                                 {"reorder", BusAction::kReorder, "bus id count"},
                                                 {"disturb", BusAction::kDisturb, "bus id count"},
                                                 {"refuse", BusAction::kRefuse, "bus id count"},
                                                 {"send", BusAction::kSend, "bus id data load_percent"},
                                                 {"cut", BusAction::kCut, "bus"},
                                                 {"down", BusAction::kDown, "bus"},
                                                 {"restart", BusAction::kRestart, "bus"},
                                                 {"swap", BusAction::kSwap, "bus with_bus"},
                                                 {"pause", BusAction::kPause, ""}}};

bool holds(std::string_view words, std::string_view word) {
  const std::string padded = " " + std::string(words) + " ";
  return padded.find(" " + std::string(word) + " ") != std::string::npos;
}

// One entry of the script and how messages call it.
struct Entry {
  const Json& json;
  std::string where;

  bool has(const std::string& field) const { return json.contains(field); }

  [[noreturn]] void refuse(const std::string& field, const std::string& allowed) const {
    const std::string found = has(field) ? json.at(field).dump() : "missing";
    throw std::runtime_error(where + field + ": " + found + ": allowed " + allowed);
  }

  std::uint64_t number(const std::string& field, std::uint64_t least, std::uint64_t most) const {
    const bool whole = has(field) && json.at(field).is_number_unsigned();
    const std::uint64_t value = whole ? json.at(field).get<std::uint64_t>() : 0;
    if (!whole || value < least || value > most)
      refuse(field, "is a whole number " + std::to_string(least) + " to " + std::to_string(most));
    return value;
  }

  std::uint64_t number_or(const std::string& field, std::uint64_t least, std::uint64_t most,
                          std::uint64_t otherwise) const {
    return has(field) ? number(field, least, most) : otherwise;
  }
};

const ActionFields& read_action(const Entry& entry) {
  std::string names;
  for (const ActionFields& each : kActions) {
    if (entry.has("action") && entry.json.at("action") == each.name) return each;
    names += (names.empty() ? "" : ", ") + std::string(each.name);
  }
  entry.refuse("action", "are " + names);
}

std::optional<std::uint32_t> read_id(const Entry& entry) {
  if (!entry.has("id")) return std::nullopt;
  const auto& id = entry.json.at("id");
  if (id.is_number_unsigned()) return static_cast<std::uint32_t>(entry.number("id", 0, 0x1FFFFFFF));
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

// The frame a stranger sends: an 11-bit id and up to 8 bytes in hex.
bus::CanFrame read_frame(const Entry& entry, const std::optional<std::uint32_t>& id) {
  if (!id || *id > bus::kCanStandardMask)
    entry.refuse("id", "is the 11-bit identifier of the frame to send, like \"0x000\"");
  bus::CanFrame frame;
  frame.id = *id;
  const std::string text =
      entry.has("data") && entry.json.at("data").is_string() ? entry.json.at("data").get<std::string>() : "";
  const bool is_hex = text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  if ((entry.has("data") && text.empty()) || !is_hex || text.size() % 2 != 0 || text.size() > 16)
    entry.refuse("data", "are up to 8 bytes in hex, like \"8104\"");
  for (std::size_t i = 0; i < text.size(); i += 2)
    frame.data[frame.length++] = static_cast<std::uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16));
  return frame;
}

BusFault read_fault(const Entry& entry, int bus_count) {
  if (!entry.json.is_object())
    throw std::runtime_error(entry.where +
                             " is not an object; write {\"action\":\"drop\",\"bus\":0,\"from_slot\":100,...}");
  const ActionFields& action = read_action(entry);
  const std::string known = "action from_slot to_slot " + std::string(action.fields);
  for (const auto& [key, value] : entry.json.items()) {
    if (!holds(known, key)) entry.refuse(key, "with action " + std::string(action.name) + " are only " + known);
  }
  const auto last_bus = static_cast<std::uint64_t>(bus_count - 1);
  BusFault fault;
  fault.action = action.action;
  fault.from_slot = entry.number("from_slot", 0, kLastSlot);
  fault.to_slot = entry.number_or("to_slot", 0, kLastSlot, kLastSlot);
  if (fault.to_slot < fault.from_slot) entry.refuse("to_slot", "is from_slot or later");
  if (holds(action.fields, "bus")) fault.bus = static_cast<int>(entry.number("bus", 0, last_bus));
  fault.id = read_id(entry);
  fault.count = static_cast<std::uint32_t>(entry.number_or("count", 1, kLastSlot, fault.count));
  if (action.action == BusAction::kSwap) fault.with_bus = static_cast<int>(entry.number("with_bus", 0, last_bus));
  if (action.action == BusAction::kSwap && fault.with_bus == fault.bus)
    entry.refuse("with_bus", "is another bus than bus");
  if (action.action == BusAction::kSend) fault.frame = read_frame(entry, fault.id);
  fault.load_percent = static_cast<int>(entry.number_or("load_percent", 1, 100, 0));
  return fault;
}

}  // namespace

bool FaultScript::takes(BusAction action, int bus, std::uint32_t id, std::uint64_t slot) {
  for (BusFault& fault : faults_) {
    if (fault.action != action || fault.bus != bus || !covers(fault, slot) || fault.count == 0 ||
        fault.id.value_or(id) != id)
      continue;
    --fault.count;
    return true;
  }
  return false;
}

bool FaultScript::lasts(BusAction action, int bus, std::uint64_t slot) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const BusFault& fault) {
    return fault.action == action && fault.bus == bus && covers(fault, slot);
  });
}

int FaultScript::across(int bus, std::uint64_t slot) const {
  for (const BusFault& fault : faults_) {
    if (fault.action != BusAction::kSwap || !covers(fault, slot)) continue;
    if (fault.bus == bus) return fault.with_bus;
    if (fault.with_bus == bus) return fault.bus;
  }
  return bus;
}

std::uint64_t FaultScript::awake_from(std::uint64_t slot) const {
  for (const BusFault& fault : faults_) {
    if (fault.action == BusAction::kPause && covers(fault, slot)) return fault.to_slot + 1;
  }
  return slot;
}

FaultScript load_fault_script(const std::string& path, int bus_count) {
  const auto text = file::content_of(path);
  if (!text) throw std::runtime_error(path + ": cannot be read; give the fault script of --script");
  return parse_fault_script(*text, path, bus_count);
}

FaultScript parse_fault_script(const std::string& text, const std::string& path, int bus_count) {
  const Json script = parse_file(text, path);
  if (!script.is_array())
    throw std::runtime_error(path + ": is not a JSON array of faults (docs/reference/bus-protocol.md)");
  std::vector<BusFault> faults;
  for (std::size_t i = 0; i < script.size(); ++i)
    faults.push_back(read_fault({script[i], path + ": [" + std::to_string(i) + "]."}, bus_count));
  return FaultScript(std::move(faults));
}

}  // namespace liana::bus_simulator
