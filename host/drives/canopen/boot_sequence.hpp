// Boots all nodes of all buses at once: one SDO exchange per node and tick, whatever number of axes it has. Nothing
// allocates after construction.
#pragma once

#include <vector>

#include "host/drives/bus/drive_bus.hpp"
#include "host/drives/canopen/boot_node.hpp"

namespace liana::canopen {

enum class BootState : std::uint8_t { kRunning, kOperational, kFailed };

// How far the boot is; for status lines.
struct BootProgress {
  int nodes = 0;
  int configured = 0;  // or further
  int operational = 0;
  int failed = 0;
  std::size_t objects_done = 0;
  std::size_t objects_total = 0;
};

class BootSequence {
 public:
  // Drives count by node, then by axis. Each node has the time that its type allows, at so many ticks a second.
  BootSequence(const std::vector<ExpectedDrive>& drives, double rate_hz);
  // All have the same.
  BootSequence(const std::vector<ExpectedDrive>& drives, const BootTiming& timing);

  // Once per tick, after the received frames have been passed to on_frame(): sends what each node needs next.
  // No node is started before all are configured; when one fails, the others go on to the end of their plan and none is
  // started. Missing nodes are asked for again and again, also after that: one that comes late is booted.
  void step(bus::DriveBus& bus) noexcept;
  // Boot-up messages, heartbeats and SDO responses; other frames are ignored. A node that restarts is booted again,
  // alone (CiA 302-2, boot of a slave that comes back): the state is kRunning until it is done.
  void on_frame(int bus, const bus::CanFrame& frame) noexcept;
  // Somebody wants a drive back (clear), and so its node: BootNode::recover.
  void recover(std::size_t drive, NodeSeen seen) noexcept;

  BootState state() const noexcept { return state_; }
  BootProgress progress() const noexcept;
  // Of the node of a drive, in the order given; no mismatches = ok so far.
  std::span<const BootMismatch> mismatches(std::size_t drive) const noexcept { return node_of(drive).mismatches(); }
  std::uint32_t more_mismatches(std::size_t drive) const noexcept { return node_of(drive).more_mismatches(); }
  std::uint32_t serial(std::size_t drive) const noexcept { return node_of(drive).serial(); }
  // Whether a drive that has gone through its plan has this object of it, named as axis 1 has it.
  bool has(std::size_t drive, config::ObjectId object) const noexcept {
    return node_of(drive).has({on_axis(object.index, drives_[drive].axis), object.sub});
  }
  NodePhase phase(std::size_t drive) const noexcept { return node_of(drive).phase(); }

 private:
  struct Drive {
    std::size_t node = 0;  // among nodes_
    std::uint8_t axis = 1;
  };

  void add(std::span<const ExpectedDrive> axes, const BootTiming& timing);
  const BootNode& node_of(std::size_t drive) const noexcept { return nodes_[drives_[drive].node]; }
  int count(NodePhase least, NodePhase most) const noexcept;
  void update_state() noexcept;

  std::vector<BootNode> nodes_;
  std::vector<Drive> drives_;
  BootState state_ = BootState::kRunning;
};

}  // namespace liana::canopen
