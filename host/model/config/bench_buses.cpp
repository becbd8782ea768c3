#include "host/model/config/bench_buses.hpp"

#include "host/base/json/json.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/robot_parts.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::config {
namespace {

constexpr std::int32_t kBitrate = 1000000;
constexpr double kRate_hz = 250.0;
constexpr double kMaxLoad = 0.75;
constexpr std::int32_t kHeartbeat_ms = 100;

// `drives` nodes on `count` buses, the first ones with one more where it does not come out even.
std::vector<BusConfig> shared_out(std::int32_t drives, std::int32_t count) {
  std::vector<BusConfig> buses(static_cast<std::size_t>(count));
  std::int32_t node = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    BusConfig& bus = buses[static_cast<std::size_t>(i)];
    bus.name = "can" + std::to_string(i);
    bus.bitrate = kBitrate;
    const std::int32_t share = drives / count + (i < drives % count ? 1 : 0);
    for (std::int32_t k = 0; k < share; ++k) bus.nodes.push_back(++node);
  }
  return buses;
}

std::vector<BusConfig> fewest(std::int32_t drives) {
  BusesConfig tried;
  tried.rate_hz = kRate_hz;
  tried.heartbeat_ms = kHeartbeat_ms;
  std::int32_t count = 1;
  do tried.buses = shared_out(drives, count++);
  while (worst_case_load(tried, 0) > kMaxLoad);
  return tried.buses;
}

}  // namespace

std::int32_t drive_count(const std::string& robot_text, const std::string& file) {
  if (robot_kind(robot_text, file) == "serial") return parse_serial_robot(robot_text, file).table.joint_count;
  return parse_robot_alone(robot_text, file).table.cable_count();
}

std::string bench_buses(std::int32_t drives) {
  Json buses = Json::array();
  for (const BusConfig& bus : fewest(drives)) {
    Json nodes = Json::array();
    for (const DrivePlace& place : bus.nodes) nodes.push_back(place.node);
    buses.push_back({{"name", bus.name}, {"bitrate", bus.bitrate}, {"nodes", nodes}});
  }
  return canonical_json({{"format", 1},
                         {"kind", "buses"},
                         {"name", "bench_" + std::to_string(drives)},
                         {"backend", "embedded"},
                         {"rate_hz", kRate_hz},
                         {"command_interval_s", 0.02},
                         {"buses", buses},
                         {"heartbeat_ms", kHeartbeat_ms},
                         {"max_load", kMaxLoad}});
}

}  // namespace liana::config
