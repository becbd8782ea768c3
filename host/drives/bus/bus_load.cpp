#include "host/drives/bus/bus_load.hpp"

#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>

#include "host/drives/bus/drive_bus.hpp"
#include "host/drives/bus/frame_bits.hpp"

namespace liana::bus {
namespace {

constexpr std::size_t kMaxNameLength = 11;  // 12 bytes with the final zero in WELCOME
constexpr int kMaxDriveNode = 126;          // 127 is the master

[[noreturn]] void refuse(const config::BusesConfig& config, const std::string& field, const std::string& value,
                         const std::string& allowed) {
  throw std::runtime_error("bus table " + config.name + ": " + field + ": " + value + ": " + allowed);
}

std::string shortest(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

void check_timing(const config::BusesConfig& config) {
  const double period_us = 1e6 / config.rate_hz;
  const bool whole = config.rate_hz > 0.0 && std::fabs(period_us - std::round(period_us)) < 1e-6;
  if (!whole || config::interpolation_period(static_cast<std::int32_t>(std::lround(period_us))).value == 0) {
    refuse(config, "rate_hz", shortest(config.rate_hz),
           "object 60C2 of the drives cannot express this period; allowed are rates whose period is 1 to 255 times a "
           "power of ten seconds, "
           "as 100, 125, 200, 250, 500 and 1000 Hz");
  }
  const double ticks = config.command_interval_s * config.rate_hz;
  if (std::round(ticks) < 1.0 || std::fabs(ticks - std::round(ticks)) > 1e-9) {
    refuse(config, "command_interval_s", shortest(config.command_interval_s),
           "allowed are whole multiples of the period, " + shortest(1.0 / config.rate_hz) + " s; change it or rate_hz");
  }
  if (config.heartbeat_ms < 1)
    refuse(config, "heartbeat_ms", std::to_string(config.heartbeat_ms), "allowed is 1 or more");
}

void check_nodes(const config::BusesConfig& config, std::size_t b, std::set<int>& used) {
  const config::BusConfig& bus = config.buses[b];
  const std::string field = "buses[" + std::to_string(b) + "].";
  if (bus.name.empty() || bus.name.size() > kMaxNameLength)
    refuse(config, field + "name", "'" + bus.name + "'", "allowed are 1 to 11 letters");
  if (bus.bitrate < 10000 || bus.bitrate > 1000000) {
    refuse(config, field + "bitrate", std::to_string(bus.bitrate),
           "allowed is 10000 to 1000000 bit/s, the range of classical CAN");
  }
  for (const auto& [node, axis] : bus.nodes) {
    if (node < 1 || node > kMaxDriveNode)
      refuse(config, field + "nodes", std::to_string(node), "allowed is 1 to 126; 127 is the master");
    if (axis == 1 && !used.insert(node).second)
      refuse(config, field + "nodes", std::to_string(node), "each node id once over all buses");
  }
}

void check_load(const config::BusesConfig& config, std::size_t b) {
  const double load = worst_load_with_sdo(config, b);
  if (load <= config.max_load) return;
  refuse(config, "buses[" + std::to_string(b) + "].nodes",
         std::to_string(config.buses[b].nodes.size()) + " drives at " + shortest(config.rate_hz) + " Hz load " +
             config.buses[b].name + " to " + shortest(std::round(1000.0 * load) / 10.0) + " % at worst",
         "allowed is max_load, " + shortest(100.0 * config.max_load) +
             " %; lower rate_hz, raise bitrate or spread the drives over more buses");
}

}  // namespace

double worst_bits_per_second(const LoadTerms& terms) {
  const auto rpdo = worst_frame_bits(static_cast<std::uint32_t>(terms.rpdo_bytes));
  const auto tpdo = worst_frame_bits(static_cast<std::uint32_t>(terms.tpdo_bytes));
  const double period_bits = worst_frame_bits(0) + static_cast<double>(terms.drives) * (rpdo + tpdo);
  return period_bits * terms.rate_hz + terms.heartbeats_per_s * worst_frame_bits(1) +
         2.0 * terms.sdo_pairs_per_s * worst_frame_bits(8) + terms.other_bits_per_s;
}

LoadTerms load_terms(const config::BusesConfig& config, std::size_t bus) {
  LoadTerms terms;
  terms.rate_hz = config.rate_hz;
  terms.drives = static_cast<int>(config.buses[bus].nodes.size());
  const config::BusConfig& own = config.buses[bus];
  terms.heartbeats_per_s = static_cast<double>(own.drive_nodes() + own.sensors() + 1) * 1000.0 / config.heartbeat_ms;
  terms.other_bits_per_s = config::worst_extra_bits_per_s(own, config.rate_hz, config::torque_drives(config, bus));
  return terms;
}

double worst_load_with_sdo(const config::BusesConfig& config, std::size_t bus) {
  return worst_bits_per_second(load_terms(config, bus)) / config.buses[bus].bitrate;
}

void check_buses(const config::BusesConfig& config) {
  if (config.buses.empty() || config.buses.size() > static_cast<std::size_t>(kMaxDriveBuses)) {
    refuse(config, "buses", std::to_string(config.buses.size()), "allowed are 1 to 8 buses");
  }
  check_timing(config);
  std::set<int> used;
  for (std::size_t b = 0; b < config.buses.size(); ++b) {
    check_nodes(config, b, used);
    check_load(config, b);
  }
}

}  // namespace liana::bus
