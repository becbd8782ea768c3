// Buses: checks of the table and what follows from it (period, load).
#include <algorithm>
#include <cmath>
#include <map>

#include "host/model/config/canonical.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/drive_types_of_buses.hpp"
#include "host/model/config/field.hpp"

namespace liana::config {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;
constexpr std::size_t kMaxBuses = 8;
constexpr double kSdoPairsPerSecond = 20.0;  // as host/drives/bus/bus_load.hpp has it
constexpr std::int64_t kMasterNode = 127;    // docs/reference/drives.md
constexpr double kMaxReading = 32767.0;      // of a load cell: 16 bits
constexpr std::size_t kMaxCellChannels = 4;  // of a node: 16 bits each in one frame

// Takes a node id, which nobody else has.
std::int32_t read_node(const Field& field, const std::string& bus, std::map<std::int32_t, std::string>& owner) {
  const auto node = static_cast<std::int32_t>(field.integer(1, kMasterNode - 1));
  if (!owner.emplace(node, bus).second)
    field.refuse("a node id that nobody else has", "it is already on bus " + owner[node]);
  return node;
}

LoadCellNode read_load_cells(const Field& field, const std::string& bus, std::map<std::int32_t, std::string>& owner) {
  field.only({"node", "cables", "zero_N"});
  LoadCellNode out;
  out.node = read_node(field.at("node"), bus, owner);
  const Field cables = field.at("cables");
  const std::size_t count = cables.size(1, kMaxCellChannels, "one cable for each channel of the node");
  for (std::size_t i = 0; i < count; ++i)
    out.cables.push_back(static_cast<std::size_t>(cables.element(i).integer(1, cable::kMaxCables) - 1));
  out.zero_N.assign(count, 0.0);
  if (!field.json().contains("zero_N")) return out;
  const Field zeros = field.at("zero_N");
  zeros.size(count, count, "one for each of its cables");
  for (std::size_t i = 0; i < count; ++i) out.zero_N[i] = zeros.element(i).number({-1000, 1000});
  return out;
}

bool is_listed(const BusConfig& bus, DrivePlace place) {
  return std::find(bus.nodes.begin(), bus.nodes.end(), place) != bus.nodes.end();
}

// A node id, which is its axis 1, or { node = 1, axis = 2 }.
DrivePlace read_place(const Field& field, const BusConfig& bus, std::map<std::int32_t, std::string>& owner) {
  const bool has_axis = field.json().is_object();
  if (has_axis) field.only({"node", "axis"});
  const Field node = has_axis ? field.at("node") : field;
  const DrivePlace place(static_cast<std::int32_t>(node.integer(1, kMasterNode - 1)),
                         has_axis ? static_cast<std::int32_t>(field.at("axis").integer(1, kMaxAxes)) : 1);
  if (place.axis == 1 && !owner.emplace(place.node, bus.name).second)
    node.refuse("each node id once", "it is already on bus " + owner[place.node]);
  if (place.axis > 1 && is_listed(bus, place)) field.refuse("each axis of a node once", "list another axis or node");
  return place;
}

BusConfig read_bus(const Field& field, std::map<std::int32_t, std::string>& owner) {
  field.only({"name", "bitrate", "nodes", "wrist_sensor", "adapter", "load_cells"});
  BusConfig bus;
  bus.name = field.at("name").name(11);  // 12 bytes with the final zero, docs/reference/bus-protocol.md
  bus.bitrate = static_cast<std::int32_t>(field.at("bitrate").integer(10000, 1000000));
  const Field nodes = field.at("nodes");
  const std::size_t count = nodes.size(1, cable::kMaxCables, "list the node ids of the drives on this bus");
  for (std::size_t i = 0; i < count; ++i) bus.nodes.push_back(read_place(nodes.element(i), bus, owner));
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_listed(bus, {bus.nodes[i].node, 1}))
      nodes.element(i).refuse("further axes of nodes whose axis 1 is on this bus",
                              "list node " + std::to_string(bus.nodes[i].node) + " itself, too");
  }
  for (const auto& [key, place] : {std::pair{"wrist_sensor", &bus.wrist_sensor}, std::pair{"adapter", &bus.adapter}}) {
    if (field.json().contains(key)) *place = read_node(field.at(key), bus.name, owner);
  }
  if (!field.json().contains("load_cells")) return bus;
  const Field cells = field.at("load_cells");
  for (std::size_t i = 0; i < cells.size(1, cable::kMaxCables, "list the nodes that read load cells"); ++i)
    bus.load_cells.push_back(read_load_cells(cells.element(i), bus.name, owner));
  return bus;
}

// A serial arm has one wrist, and pushes into one adapter.
void check_sensors(const Field& table, const BusesConfig& buses) {
  std::int32_t wrists = 0, adapters = 0;
  for (const BusConfig& bus : buses.buses) {
    wrists += bus.wrist_sensor != 0;
    adapters += bus.adapter != 0;
  }
  if (wrists > 1 || adapters > 1)
    table.at("buses").refuse("one wrist_sensor and one adapter in all", "leave the others out");
}

// Each cable has one cell at most, and what they have in common is said once.
void read_load_cell(const Field& table, BusesConfig& buses) {
  std::map<std::size_t, std::int32_t> node_of;
  for (std::size_t b = 0; b < buses.buses.size(); ++b) {
    for (const LoadCellNode& node : buses.buses[b].load_cells) {
      for (const std::size_t cable : node.cables) {
        if (node_of.emplace(cable, node.node).second) continue;
        table.at("buses")
            .element(b)
            .at("load_cells")
            .refuse("each cable once", "cable " + std::to_string(cable + 1) + " is already read by node " +
                                           std::to_string(node_of[cable]));
      }
    }
  }
  if (node_of.empty()) return;
  const Field cell = table.at("load_cell");
  cell.only({"newtons_per_step", "range_N", "agree_N", "when_lost"});
  buses.load_cell.newtons_per_step = cell.at("newtons_per_step").number({1e-6, 10});
  buses.load_cell.range_N = cell.at("range_N").number({1, 1e5});
  const double most_N = kMaxReading * buses.load_cell.newtons_per_step;
  if (buses.load_cell.range_N > most_N)
    cell.at("range_N").refuse("at most " + Json(most_N).dump() + ", 32767 steps of newtons_per_step",
                              "readings have 16 bits: take larger steps, or a smaller range");
  buses.load_cell.agree_N = cell.at("agree_N").number({0.1, 1e4});
  buses.load_cell.goes_on = cell.at("when_lost").choice({"hold", "torque"}) == "torque";
}

void check_timing(const Field& table, const BusesConfig& buses) {
  const Field rate = table.at("rate_hz");
  const double period_us = kMicrosecondsPerSecond / buses.rate_hz;
  const bool whole = std::fabs(period_us - std::round(period_us)) < 1e-6;
  if (!whole || interpolation_period(static_cast<std::int32_t>(std::lround(period_us))).value == 0) {
    rate.refuse("rates whose period is 1 to 255 times a power of ten seconds (100, 125, 200, 250, 500, 1000 Hz)",
                "object 60C2 of the drives cannot express this period");
  }
  const double ticks = buses.command_interval_s * buses.rate_hz;
  if (std::round(ticks) < 1.0 || std::fabs(ticks - std::round(ticks)) > 1e-9) {
    table.at("command_interval_s")
        .refuse("whole multiples of the period, " + canonical_number(1.0 / buses.rate_hz) + " s",
                "change it or rate_hz");
  }
}

void check_load(const Field& table, const BusesConfig& buses) {
  for (std::size_t i = 0; i < buses.buses.size(); ++i) {
    const double load = worst_case_load(buses, i);
    if (load <= buses.max_load) continue;
    const std::string percent = canonical_number(std::round(load * 1000) / 10);
    table.at("buses").element(i).at("nodes").refuse(
        "a worst-case load up to " + canonical_number(100 * buses.max_load) + " %, here " + percent + " %",
        "lower rate_hz, raise bitrate or use more buses");
  }
}

Machine read_machine(const Field& field) {
  field.only({"mips", "tick_share"});
  return {field.at("mips").number({1, 1e6}), field.at("tick_share").number({0, 1, true})};
}

// Bits of a classical CAN frame with 11-bit identifier, worst stuffing, interframe space included (can-utils'
// constants).
constexpr double worst_frame_bits(int bytes) { return 55.0 + 10.0 * bytes; }

}  // namespace

std::int32_t BusesConfig::period_us() const {
  return static_cast<std::int32_t>(std::lround(kMicrosecondsPerSecond / rate_hz));
}

std::int32_t BusesConfig::interval_ticks() const {
  return static_cast<std::int32_t>(std::lround(command_interval_s * rate_hz));
}

std::int32_t BusesConfig::bus_of_node(std::int32_t node) const {
  for (std::size_t i = 0; i < buses.size(); ++i) {
    for (const DrivePlace& each : buses[i].nodes) {
      if (each.node == node) return static_cast<std::int32_t>(i);
    }
  }
  return -1;
}

std::vector<DrivePlace> BusesConfig::places() const {
  std::vector<DrivePlace> out;
  for (const BusConfig& bus : buses) out.insert(out.end(), bus.nodes.begin(), bus.nodes.end());
  std::sort(out.begin(), out.end());
  return out;
}

std::size_t BusConfig::drive_nodes() const {
  return static_cast<std::size_t>(
      std::count_if(nodes.begin(), nodes.end(), [](const DrivePlace& place) { return place.axis == 1; }));
}

InterpolationPeriod interpolation_period(std::int32_t period_us) {
  InterpolationPeriod period{0, -6};
  std::int32_t value = period_us;
  while (value > 0 && value % 10 == 0) {
    value /= 10;
    ++period.exponent;
  }
  if (value > 0 && value <= 255) period.value = static_cast<std::uint8_t>(value);
  return period;
}

std::int32_t torque_drives(const BusesConfig& buses, std::size_t bus) {
  std::int32_t count = 0;
  const std::map<std::int32_t, DriveType> types = drive_types(buses);
  for (const DrivePlace& place : buses.buses[bus].nodes) {
    const auto named = types.find(place.node);
    if (named != types.end() && named->second.is_cst) ++count;
  }
  return count;
}

// A torque drive's command is two bytes longer, and it has a TPDO2. The sensor has two frames a tick, the adapter one
// every fourth tick, and it is told as often; a node with load cells has one a tick.
double worst_extra_bits_per_s(const BusConfig& bus, double rate_hz, std::int32_t torque_drives) {
  double tick_bits = torque_drives * (worst_frame_bits(8) - worst_frame_bits(6) + worst_frame_bits(4));
  if (bus.wrist_sensor != 0) tick_bits += 2.0 * worst_frame_bits(8);
  if (bus.adapter != 0) tick_bits += (worst_frame_bits(8) + worst_frame_bits(2)) / 4.0;
  for (const LoadCellNode& node : bus.load_cells)
    tick_bits += worst_frame_bits(2 * static_cast<int>(node.cables.size()));
  return tick_bits * rate_hz;
}

double worst_case_load(const BusesConfig& buses, std::size_t bus) {
  const BusConfig& own = buses.buses[bus];
  const auto drives = static_cast<double>(own.nodes.size());
  const auto nodes = static_cast<double>(own.drive_nodes() + own.sensors());
  const double tick_bits = worst_frame_bits(0) + drives * (worst_frame_bits(6) + worst_frame_bits(8));
  const double heartbeat_bits = (nodes + 1.0) * worst_frame_bits(1);
  const double sdo_bits = 2.0 * worst_frame_bits(8);  // request and response
  const double bits_per_second = tick_bits * buses.rate_hz + heartbeat_bits * 1000.0 / buses.heartbeat_ms +
                                 sdo_bits * kSdoPairsPerSecond +
                                 worst_extra_bits_per_s(own, buses.rate_hz, torque_drives(buses, bus));
  return bits_per_second / buses.buses[bus].bitrate;
}

BusesConfig parse_buses(const std::string& text, const std::string& file) {
  const Json json = parse_json(text, file);
  const Field table(json, file, "");
  check_kind(table, "buses");
  table.only({"format", "kind", "name", "backend", "rate_hz", "command_interval_s", "buses", "heartbeat_ms", "max_load",
              "machine", "drives", "drive_types", "load_cell"});
  BusesConfig out;
  out.name = table.at("name").name(40);
  out.backend = table.at("backend").choice({"embedded", "socketcan"});
  out.rate_hz = table.at("rate_hz").number({10, 1000});
  out.command_interval_s = table.at("command_interval_s").number({0.001, 0.1});
  out.heartbeat_ms = static_cast<std::int32_t>(table.at("heartbeat_ms").integer(10, 1000));
  out.max_load = table.at("max_load").number({0, 0.9, true});
  if (json.contains("machine")) out.machine = read_machine(table.at("machine"));
  const Field list = table.at("buses");
  const std::size_t count = list.size(1, kMaxBuses, "describe each CAN bus");
  std::map<std::int32_t, std::string> owner;
  for (std::size_t i = 0; i < count; ++i) out.buses.push_back(read_bus(list.element(i), owner));
  check_drive_types(table, out);
  check_sensors(table, out);
  read_load_cell(table, out);
  check_timing(table, out);
  out.canonical_json = canonical_json(json);
  check_load(table, out);
  return out;
}

BusesConfig load_buses(const std::string& path) { return parse_buses(read_text_file(path), path); }

}  // namespace liana::config
