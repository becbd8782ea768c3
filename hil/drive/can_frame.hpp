// A classical CAN frame and little-endian fields, the bench's own.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace liana::bench {

struct CanFrame {
  std::uint64_t time_us = 0;  // received: end on the wire
  std::uint32_t id = 0;       // 11 bits; bit 30 RTR, bit 31 extended, as in linux/can.h
  std::uint8_t bus = 0;       // 0-based
  std::uint8_t length = 0;    // 0..8
  std::array<std::uint8_t, 8> data{};
};

using FrameList = std::vector<CanFrame>;

// `count` bytes (1..8) from `from`, least significant first.
inline std::uint64_t get_little_endian(const std::uint8_t* from, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint64_t>(from[i]) << (8 * i);
  return value;
}

inline void put_little_endian(std::uint8_t* to, std::size_t count, std::uint64_t value) {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

}  // namespace liana::bench
