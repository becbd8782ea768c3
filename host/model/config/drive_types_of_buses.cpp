#include "host/model/config/drive_types_of_buses.hpp"

#include "host/model/config/field.hpp"

namespace liana::config {
namespace {

constexpr std::int64_t kMaxNodeId = 126;

// The type called `name`: evaluating the bus table has put it beside the names
// (host/apps/mission_runner/drive_tables.hpp).
DriveType named_type(const Field& table, const Field& name) {
  const std::string type = name.name(40);
  const Json* found = table.json().member_or_null("drive_types").find(type);
  if (found == nullptr) name.refuse("a type that drive_types of the table has", "export the bus table again");
  DriveType out = parse_drive_type(*found, table.file() + ": drive_types." + type);
  if (out.name != type) name.refuse("the name that the type gives itself, " + out.name, "use one name for both");
  return out;
}

void add_types(const Field& table, const Field& entry, const BusesConfig& buses,
               std::map<std::int32_t, DriveType>& types) {
  entry.only({"type", "nodes", "bench"});
  const DriveType type = named_type(table, entry.at("type"));
  if (entry.json().contains("bench")) named_type(table, entry.at("bench"));
  const Field nodes = entry.at("nodes");
  const std::size_t count = nodes.size(1, cable::kMaxCables, "list the node ids of the drives of this type");
  for (std::size_t i = 0; i < count; ++i) {
    const Field field = nodes.element(i);
    const auto node = static_cast<std::int32_t>(field.integer(1, kMaxNodeId));
    if (buses.bus_of_node(node) < 0) field.refuse("a node of one of the buses", "add it to a bus");
    if (!types.emplace(node, type).second) field.refuse("each node once", "decide what it is");
  }
}

std::map<std::int32_t, DriveType> read_types(const Field& table, const BusesConfig& buses) {
  std::map<std::int32_t, DriveType> types;
  if (!table.json().contains("drives")) return types;
  const Field list = table.at("drives");
  const std::size_t count = list.size(0, cable::kMaxCables, "one entry for each type");
  for (std::size_t i = 0; i < count; ++i) add_types(table, list.element(i), buses, types);
  return types;
}

}  // namespace

std::map<std::int32_t, DriveType> drive_types(const BusesConfig& buses) {
  if (buses.canonical_json.empty()) return {};
  const Json json = parse_json(buses.canonical_json, buses.name);
  return read_types(Field(json, buses.name, ""), buses);
}

void check_drive_types(const Field& table, const BusesConfig& buses) { read_types(table, buses); }

}  // namespace liana::config
