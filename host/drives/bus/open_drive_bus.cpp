#include <stdexcept>

#include "host/drives/bus/bus_load.hpp"
#include "host/drives/bus/embedded_realtime_bus.hpp"
#include "host/drives/bus/lockstep_bus.hpp"
#include "host/drives/bus/socketcan_bus.hpp"

namespace liana::bus {
namespace {

std::unique_ptr<DriveBus> open_embedded(const config::BusesConfig& config, timing::TimeMode mode,
                                        const std::string& bus_socket) {
  if (bus_socket.empty()) {
    throw std::runtime_error("bus table " + config.name +
                             ": backend embedded needs the socket of liana-bus; give it with --bus-socket PATH");
  }
  auto link = std::make_unique<EmbeddedLink>(bus_socket, config);
  const auto runs = static_cast<timing::TimeMode>(link->welcome().time_mode);
  if (runs != mode) {
    throw std::runtime_error("bus socket " + bus_socket + ": liana-bus runs in " +
                             std::string(timing::time_mode_name(runs)) + " time, asked was " +
                             std::string(timing::time_mode_name(mode)) + "; start both with the same --time");
  }
  if (mode == timing::TimeMode::kReal) return std::make_unique<EmbeddedRealtimeBus>(std::move(link));
  return std::make_unique<LockstepBus>(std::move(link));
}

}  // namespace

std::unique_ptr<DriveBus> open_drive_bus(const config::BusesConfig& config, timing::TimeMode mode,
                                         const std::string& bus_socket) {
  check_buses(config);
  if (config.backend == "embedded") return open_embedded(config, mode, bus_socket);
  if (config.backend != "socketcan") {
    throw std::runtime_error("bus table " + config.name + ": backend: '" + config.backend +
                             "': allowed are embedded and socketcan");
  }
  if (mode != timing::TimeMode::kReal) {
    throw std::runtime_error("bus table " + config.name + ": time " + std::string(timing::time_mode_name(mode)) +
                             ": SocketCAN has no virtual time; use --time real, or a table with the embedded backend");
  }
  return std::make_unique<SocketCanBus>(config);
}

}  // namespace liana::bus
