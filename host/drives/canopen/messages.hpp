// The short messages of a CANopen master.
#pragma once

#include "host/drives/bus/can_frame.hpp"
#include "host/drives/canopen/cob_id.hpp"

namespace liana::canopen {

// NMT command for `node`, 0 = all.
constexpr bus::CanFrame nmt_frame(std::uint8_t command, std::uint8_t node) noexcept {
  return {kNmtId, 2, {command, node}, 0};
}

// Heartbeat of `node` in `state`.
constexpr bus::CanFrame heartbeat_frame(std::uint8_t node, std::uint8_t state) noexcept {
  return {kHeartbeatBase + node, 1, {state}, 0};
}

// `count` bytes (1..4) of `from`, least significant first.
constexpr std::uint32_t get_u32(const std::uint8_t* from, std::size_t count) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint32_t>(from[i]) << (8 * i);
  return value;
}

// The lowest `count` bytes (1..4) of `value`, least significant first.
constexpr void put_u32(std::uint8_t* to, std::size_t count, std::uint32_t value) noexcept {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

}  // namespace liana::canopen
