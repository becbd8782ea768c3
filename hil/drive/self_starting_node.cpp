#include "hil/drive/self_starting_node.hpp"

#include <algorithm>

namespace liana::bench {

bool SelfStartingNode::hears(const CanFrame& frame) {
  if (frame.bus != bus_ || state_ == kBooting) return false;
  const bool for_me = frame.id == 0x000 && frame.length == 2 && (frame.data[1] == 0 || frame.data[1] == node_);
  if (for_me) command(frame.data[0]);
  if (frame.id == 0x080) ++syncs_;
  return true;
}

void SelfStartingNode::command(std::uint8_t command) {
  if (command == 0x01) state_ = kOperational;
  if (command == 0x02) state_ = kStopped;
  if (command == 0x80) state_ = kPreOperational;
  if (command == 0x81 || command == 0x82) state_ = kBooting;
}

void SelfStartingNode::tick(std::uint64_t now_us, FrameList& out) {
  const bool boots = state_ == kBooting;
  if (!boots && now_us < next_us_) return;
  send(0x700 + node_, {&state_, 1}, out);
  next_us_ = now_us + kHeartbeat_us;
  if (boots) state_ = kOperational;
}

void SelfStartingNode::send(std::uint32_t id, std::span<const std::uint8_t> bytes, FrameList& out) const {
  CanFrame frame;
  frame.bus = bus_;
  frame.id = id;
  frame.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  out.push_back(frame);
}

}  // namespace liana::bench
