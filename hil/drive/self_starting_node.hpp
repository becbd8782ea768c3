// A CANopen node that is no drive: after power-on and after every reset it says its boot-up message and goes
// operational by itself (CiA 302, 0x1F80 bit 2); a heartbeat every 100 ms; no SDO server, its mapping is fixed.
#pragma once

#include <cstdint>
#include <span>

#include "hil/drive/can_frame.hpp"

namespace liana::bench {

class SelfStartingNode {
 public:
  static constexpr std::uint64_t kHeartbeat_us = 100000;

  SelfStartingNode(std::uint32_t node, std::uint8_t bus) : node_(node), bus_(bus) {}

  // Whether a frame is on its bus; acts on NMT commands and counts SYNCs.
  bool hears(const CanFrame& frame);
  // Boot-up and heartbeat when they are due.
  void tick(std::uint64_t now_us, FrameList& out);
  // Puts a frame of these bytes on its bus.
  void send(std::uint32_t id, std::span<const std::uint8_t> bytes, FrameList& out) const;

  bool is_operational() const { return state_ == kOperational; }
  std::uint32_t node() const { return node_; }
  std::uint64_t syncs() const { return syncs_; }

 private:
  static constexpr std::uint8_t kBooting = 0, kStopped = 4, kOperational = 5, kPreOperational = 0x7F;

  void command(std::uint8_t command);

  std::uint32_t node_;
  std::uint8_t bus_;
  std::uint8_t state_ = kBooting;
  std::uint64_t syncs_ = 0;
  std::uint64_t next_us_ = 0;
};

}  // namespace liana::bench
