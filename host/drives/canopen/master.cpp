#include "host/drives/canopen/master.hpp"

#include "host/drives/canopen/messages.hpp"

namespace liana::canopen {
namespace {

constexpr std::int32_t kHeartbeatsMissed = 3;

}  // namespace

Master::Master(const std::vector<ExpectedDrive>& drives, const config::BusesConfig& buses)
    : boot_(drives, buses.rate_hz),
      producer_(buses.heartbeat_ms, buses.rate_hz),
      monitor_(kHeartbeatsMissed * buses.heartbeat_ms, buses.rate_hz),
      modes_(drives, buses) {}

bool Master::on_frame(int bus, const bus::CanFrame& frame, std::uint64_t tick) noexcept {
  const FrameRoute from = route(frame.id);
  switch (from.kind) {
    case FrameKind::kHeartbeat:
      if (frame.length == 1) monitor_.on_heartbeat(from.node, frame.data[0]);
      boot_.on_frame(bus, frame);
      return true;
    case FrameKind::kSdoResponse:
      boot_.on_frame(bus, frame);
      modes_.on_frame(bus, frame);
      return true;
    case FrameKind::kEmergency:
      emergencies_.on_frame(bus, from.node, frame, tick);
      return true;
    default:
      return false;
  }
}

void Master::step(bus::DriveBus& bus, std::uint32_t in_operation) noexcept {
  monitor_.step();
  producer_.step(bus);
  boot_.step(bus);
  modes_.step(bus, boot_.state() == BootState::kOperational ? in_operation : 0);
}

void Master::recover(std::size_t drive, std::uint8_t node, bool reports) noexcept {
  const std::uint8_t state = monitor_.state(node);
  NodeSeen seen = NodeSeen::kLost;
  if (!monitor_.lost(node) && state == kStatePreOperational) seen = NodeSeen::kPreOperational;
  if (!monitor_.lost(node) && state == kStateOperational && reports) seen = NodeSeen::kWell;
  boot_.recover(drive, seen);
}

void Master::command_all(bus::DriveBus& bus, std::uint8_t nmt_command) noexcept {
  for (int i = 0; i < bus.bus_count(); ++i) bus.send(i, nmt_frame(nmt_command, 0));
}

}  // namespace liana::canopen
