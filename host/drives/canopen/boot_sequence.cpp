#include "host/drives/canopen/boot_sequence.hpp"

#include <algorithm>

#include "host/drives/canopen/cob_id.hpp"

namespace liana::canopen {

namespace {

// The axes of each node.
std::vector<std::span<const ExpectedDrive>> by_node(std::span<const ExpectedDrive> drives) {
  std::vector<std::span<const ExpectedDrive>> nodes;
  for (; !drives.empty(); drives = drives.subspan(nodes.back().size()))
    nodes.push_back(drives.first(axes_of_first(drives)));
  return nodes;
}

}  // namespace

BootSequence::BootSequence(const std::vector<ExpectedDrive>& drives, double rate_hz) {
  for (const auto axes : by_node(drives)) add(axes, boot_timing(rate_hz, axes[0].type.times));
}

BootSequence::BootSequence(const std::vector<ExpectedDrive>& drives, const BootTiming& timing) {
  for (const auto axes : by_node(drives)) add(axes, timing);
}

void BootSequence::add(std::span<const ExpectedDrive> axes, const BootTiming& timing) {
  for (const ExpectedDrive& axis : axes) drives_.push_back({nodes_.size(), axis.axis});
  nodes_.emplace_back(axes, timing);
}

void BootSequence::step(bus::DriveBus& bus) noexcept {
  for (BootNode& node : nodes_) {
    bus::CanFrame frame;
    if (node.step(frame)) node.sent(bus.send(node.bus(), frame) == bus::SendResult::kOk);
  }
  update_state();
}

void BootSequence::on_frame(int bus, const bus::CanFrame& frame) noexcept {
  const FrameRoute from = route(frame.id);
  if (from.kind != FrameKind::kHeartbeat && from.kind != FrameKind::kSdoResponse) return;
  for (BootNode& node : nodes_) {
    if (node.node() != from.node || node.bus() != bus) continue;
    if (from.kind == FrameKind::kSdoResponse) {
      node.on_sdo_response(frame);
    } else {
      node.on_heartbeat(frame);
      if (node.phase() == NodePhase::kObjects) state_ = BootState::kRunning;
    }
  }
}

void BootSequence::recover(std::size_t drive, NodeSeen seen) noexcept {
  BootNode& node = nodes_[drives_[drive].node];
  node.recover(seen);
  if (node.phase() < NodePhase::kConfigured) state_ = BootState::kRunning;
}

int BootSequence::count(NodePhase least, NodePhase most) const noexcept {
  return static_cast<int>(std::count_if(nodes_.begin(), nodes_.end(), [=](const BootNode& node) {
    return node.phase() >= least && node.phase() <= most;
  }));
}

void BootSequence::update_state() noexcept {
  const int failed = count(NodePhase::kFailed, NodePhase::kFailed);
  const int operational = count(NodePhase::kOperational, NodePhase::kOperational);
  const bool all_configured = count(NodePhase::kConfigured, NodePhase::kOperational) == static_cast<int>(nodes_.size());
  if (all_configured) {
    for (BootNode& node : nodes_) node.allow_start();
  }
  const bool is_busy = count(NodePhase::kReset, NodePhase::kObjects) > 0;
  const bool starts = count(NodePhase::kStart, NodePhase::kWaitOperational) > 0;
  state_ = BootState::kRunning;
  if (operational == static_cast<int>(nodes_.size())) state_ = BootState::kOperational;
  if (failed > 0 && !is_busy && !starts) state_ = BootState::kFailed;
}

BootProgress BootSequence::progress() const noexcept {
  BootProgress progress;
  progress.nodes = static_cast<int>(nodes_.size());
  progress.configured = count(NodePhase::kConfigured, NodePhase::kOperational);
  progress.operational = count(NodePhase::kOperational, NodePhase::kOperational);
  progress.failed = count(NodePhase::kFailed, NodePhase::kFailed);
  for (const BootNode& node : nodes_) {
    progress.objects_done += node.objects_done();
    progress.objects_total += node.objects_total();
  }
  return progress;
}

}  // namespace liana::canopen
