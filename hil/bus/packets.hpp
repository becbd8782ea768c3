// The embedded bus's packets, written from docs/reference/bus-protocol.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/drive/can_frame.hpp"

namespace liana::bench {

using Packet = std::vector<std::uint8_t>;

constexpr std::size_t kMaxPacketFrames = 256;
constexpr std::size_t kMaxPacketBytes = 16 + 24 * kMaxPacketFrames;

struct Welcome {
  std::uint8_t time_mode = 0;  // 0 fast, 1 paced, 2 real
  std::uint32_t period_us = 0;
  std::vector<std::string> bus_names;
};

struct WakePacket {
  bool shutdown = false;
  std::uint32_t slot = 0;
  std::uint64_t now_us = 0;
  FrameList frames;           // received
  std::uint64_t refused = 0;  // own frames sent back
};

// HELLO as plant.
Packet make_hello(const std::string& name);
// YIELD with at most kMaxPacketFrames frames.
Packet make_yield(bool wake_on_sync, std::uint64_t until_us, const FrameList& frames);

// Both throw std::runtime_error for an ERROR packet (with its text) or anything malformed.
Welcome read_welcome(const Packet& packet);
WakePacket read_wake(const Packet& packet);

}  // namespace liana::bench
