#include "host/drives/canopen/heartbeat.hpp"

#include <algorithm>
#include <cmath>

#include "host/drives/canopen/messages.hpp"

namespace liana::canopen {
namespace {

double ticks(std::int32_t time_ms, double rate_hz) noexcept { return time_ms * rate_hz / 1000.0; }

}  // namespace

HeartbeatProducer::HeartbeatProducer(std::int32_t period_ms, double rate_hz) noexcept
    : period_ticks_(static_cast<std::uint32_t>(std::max(1.0, std::floor(ticks(period_ms, rate_hz))))) {}

void HeartbeatProducer::step(bus::DriveBus& bus) noexcept {
  if (until_next_ > 0) {
    --until_next_;
    return;
  }
  until_next_ = period_ticks_ - 1;
  for (int i = 0; i < bus.bus_count(); ++i) bus.send(i, heartbeat_frame(kMasterNode, kStateOperational));
}

HeartbeatMonitor::HeartbeatMonitor(std::int32_t limit_ms, double rate_hz) noexcept
    : limit_ticks_(static_cast<std::uint32_t>(std::max(1.0, std::ceil(ticks(limit_ms, rate_hz))))) {}

void HeartbeatMonitor::on_heartbeat(std::uint8_t node, std::uint8_t state) noexcept {
  Node& entry = nodes_[node & 0x7F];
  entry.age_ticks = 0;
  entry.state = state & kNmtStateMask;
  if (entry.state == kStateBootUp) ++entry.boot_ups;
}

void HeartbeatMonitor::step() noexcept {
  for (Node& node : nodes_) {
    if (node.age_ticks < UINT32_MAX - 1) ++node.age_ticks;
  }
}

}  // namespace liana::canopen
