#include "hil/bus/packets.hpp"

#include <algorithm>
#include <stdexcept>

namespace liana::bench {

namespace {

constexpr std::uint8_t kHello = 1;
constexpr std::uint8_t kWelcome = 2;
constexpr std::uint8_t kWake = 3;
constexpr std::uint8_t kYield = 4;
constexpr std::uint8_t kError = 5;
constexpr std::uint8_t kVersion = 1;
constexpr std::uint8_t kRolePlant = 1;
constexpr std::size_t kNameBytes = 28;
constexpr std::size_t kHeaderBytes = 16;
constexpr std::size_t kFrameBytes = 24;

void check(const Packet& packet, std::uint8_t type, std::size_t min_bytes) {
  if (!packet.empty() && packet[0] == kError)
    throw std::runtime_error("embedded bus: refused: " + std::string(packet.begin() + 1, packet.end()));
  if (packet.size() < min_bytes || packet[0] != type)
    throw std::runtime_error("embedded bus: packet of " + std::to_string(packet.size()) + " bytes is not of type " +
                             std::to_string(type) + "; bus and bench must come from one build");
}

std::string fixed_text(const std::uint8_t* from, std::size_t size) {
  const std::string text(from, from + size);
  return text.substr(0, text.find('\0'));
}

CanFrame read_frame(const std::uint8_t* from) {
  CanFrame frame;
  frame.time_us = get_little_endian(from, 8);
  frame.id = static_cast<std::uint32_t>(get_little_endian(from + 8, 4));
  frame.bus = from[12];
  frame.length = std::min<std::uint8_t>(from[13], 8);
  std::copy_n(from + 16, 8, frame.data.begin());
  return frame;
}

void write_frame(std::uint8_t* to, const CanFrame& frame) {
  put_little_endian(to + 8, 4, frame.id);
  to[12] = frame.bus;
  to[13] = frame.length;
  std::copy_n(frame.data.begin(), 8, to + 16);
}

}  // namespace

Packet make_hello(const std::string& name) {
  Packet packet(4 + kNameBytes, 0);
  packet[0] = kHello;
  packet[1] = kVersion;
  packet[2] = kRolePlant;
  std::copy_n(name.begin(), std::min(name.size(), kNameBytes - 1), packet.begin() + 4);
  return packet;
}

Packet make_yield(bool wake_on_sync, std::uint64_t until_us, const FrameList& frames) {
  Packet packet(kHeaderBytes + kFrameBytes * frames.size(), 0);
  packet[0] = kYield;
  packet[1] = wake_on_sync ? 1 : 0;
  put_little_endian(&packet[2], 2, frames.size());
  put_little_endian(&packet[8], 8, until_us);
  for (std::size_t i = 0; i < frames.size(); ++i) write_frame(&packet[kHeaderBytes + kFrameBytes * i], frames[i]);
  return packet;
}

Welcome read_welcome(const Packet& packet) {
  check(packet, kWelcome, 8);
  Welcome welcome;
  welcome.time_mode = packet[1];
  welcome.period_us = static_cast<std::uint32_t>(get_little_endian(&packet[4], 4));
  const std::size_t count = packet[2];
  check(packet, kWelcome, 8 + 16 * count);
  for (std::size_t b = 0; b < count; ++b) welcome.bus_names.push_back(fixed_text(&packet[8 + 16 * b + 4], 12));
  return welcome;
}

WakePacket read_wake(const Packet& packet) {
  check(packet, kWake, kHeaderBytes);
  WakePacket wake;
  wake.shutdown = (packet[1] & 1) != 0;
  const auto count = static_cast<std::size_t>(get_little_endian(&packet[2], 2));
  wake.slot = static_cast<std::uint32_t>(get_little_endian(&packet[4], 4));
  wake.now_us = get_little_endian(&packet[8], 8);
  check(packet, kWake, kHeaderBytes + kFrameBytes * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* record = &packet[kHeaderBytes + kFrameBytes * i];
    if ((record[14] & 1) != 0)
      ++wake.refused;
    else
      wake.frames.push_back(read_frame(record));
  }
  return wake;
}

}  // namespace liana::bench
