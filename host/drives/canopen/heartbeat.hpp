// Heartbeats both ways: the master's own, and the age of each drive's. Time is counted in ticks.
#pragma once

#include <array>
#include <cstdint>

#include "host/drives/bus/drive_bus.hpp"

namespace liana::canopen {

// Sends the master's heartbeat (0x77F, operational) on every bus.
class HeartbeatProducer {
 public:
  // Every `period_ms` at `rate_hz` ticks a second, rounded down to whole ticks.
  HeartbeatProducer(std::int32_t period_ms, double rate_hz) noexcept;
  // Once per tick.
  void step(bus::DriveBus& bus) noexcept;

 private:
  std::uint32_t period_ticks_;
  std::uint32_t until_next_ = 0;
};

// Listens to the drives.
class HeartbeatMonitor {
 public:
  // A node counts as lost when its last heartbeat is older than `limit_ms`.
  HeartbeatMonitor(std::int32_t limit_ms, double rate_hz) noexcept;
  // A frame with COB-ID 0x700 + node (1..127).
  void on_heartbeat(std::uint8_t node, std::uint8_t state) noexcept;
  // Once per tick, after the frames of the tick.
  void step() noexcept;

  // Ticks since the last heartbeat or boot-up; UINT32_MAX when none was ever heard.
  std::uint32_t age_ticks(std::uint8_t node) const noexcept { return nodes_[node & 0x7F].age_ticks; }
  // NMT state last heard; 0xFF when none was.
  std::uint8_t state(std::uint8_t node) const noexcept { return nodes_[node & 0x7F].state; }
  // Boot-up messages heard: a growing number says that a drive has restarted.
  std::uint32_t boot_ups(std::uint8_t node) const noexcept { return nodes_[node & 0x7F].boot_ups; }
  bool lost(std::uint8_t node) const noexcept { return age_ticks(node) > limit_ticks_; }

 private:
  struct Node {
    std::uint32_t age_ticks = UINT32_MAX;
    std::uint8_t state = 0xFF;
    std::uint32_t boot_ups = 0;
  };
  std::uint32_t limit_ticks_;
  std::array<Node, 128> nodes_{};
};

}  // namespace liana::canopen
