#include "host/drives/bus_simulator/bus_process.hpp"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "host/base/file/in_file.hpp"
#include "host/drives/bus/bus_protocol.hpp"
#include "host/drives/bus_simulator/json_file.hpp"

namespace liana::bus_simulator {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& field, const Json& value,
                         const std::string& allowed) {
  throw std::runtime_error(path + ": " + field + ": " + (value.is_null() ? "missing" : value.dump()) + ": allowed " +
                           allowed);
}

Json field(const Json& object, const char* name) {
  return object.is_object() && object.contains(name) ? object.at(name) : Json();
}

bool is_within(const Json& value, double low, double high) {
  return value.is_number() && value.get<double>() >= low && value.get<double>() <= high;
}

WireConfig read_wire(const std::string& path, const std::string& where, const Json& bus) {
  const auto name = field(bus, "name");
  const auto bitrate = field(bus, "bitrate");
  if (!name.is_string() || name.get<std::string>().empty() || name.get<std::string>().size() > 11 ||
      name.get<std::string>().find('/') != std::string::npos) {
    refuse(path, where + "name", name, "is a name of 1 to 11 letters without /");
  }
  if (!bitrate.is_number_integer() || !is_within(bitrate, 10000, 1000000))
    refuse(path, where + "bitrate", bitrate, "is 10000 to 1000000 bit/s");
  return {name.get<std::string>(), bitrate.get<std::uint32_t>()};
}

}  // namespace

void load_wires(const std::string& path, BusHubOptions& options) {
  const auto text = file::content_of(path);
  if (!text) throw std::runtime_error(path + ": cannot be read; give the bus table with --buses");
  const Json table = parse_file(*text, path);
  if (!table.is_object())
    throw std::runtime_error(path + ": is no JSON object; write it with liana-mission eval buses");
  const auto rate = field(table, "rate_hz");
  if (!is_within(rate, 1, 10000)) refuse(path, "rate_hz", rate, "is 1 to 10000 Hz");
  options.period_us = static_cast<std::uint32_t>(std::lround(1e6 / rate.get<double>()));
  const auto buses = field(table, "buses");
  if (!buses.is_array() || buses.empty() || buses.size() > wire::kMaxBuses)
    refuse(path, "buses", buses, "are 1 to 8 buses");
  for (std::size_t b = 0; b < buses.size(); ++b)
    options.wires.push_back(read_wire(path, "buses[" + std::to_string(b) + "].", buses[b]));
}

void write_bus_stats(const std::string& path, const BusHub& hub) {
  const double elapsed_s = static_cast<double>(hub.now_ns) * 1e-9;
  Json buses = Json::array();
  for (std::size_t b = 0; b < hub.sim().wires().size(); ++b) {
    const WireConfig& wire = hub.sim().wires()[b];
    const WireStats& stats = hub.sim().stats(b);
    const double load = elapsed_s > 0.0 ? static_cast<double>(stats.bits) / (wire.bitrate * elapsed_s) : 0.0;
    buses.push_back({{"name", wire.name},
                     {"frames", stats.frames},
                     {"bits", stats.bits},
                     {"load", load},
                     {"refused", stats.refused},
                     {"dropped", stats.dropped},
                     {"disturbed", stats.disturbed}});
  }
  std::ofstream file(path);
  file << Json{{"time_s", elapsed_s}, {"slots", hub.slot()}, {"ended", hub.end_reason()}, {"buses", buses}}.dump(1)
       << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written; give --stats a file in a directory you may write");
}

}  // namespace liana::bus_simulator
