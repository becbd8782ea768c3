// The length of a classical CAN frame on the wire, to the bit, and its priority (ISO 11898-1).
#pragma once

#include <cstdint>

#include "host/drives/bus/can_frame.hpp"

namespace liana::bus {

// CRC delimiter 1, ACK 2, end of frame 7, interframe space 3: never stuffed.
constexpr std::uint32_t kUnstuffedTailBits = 13;

// Bits of `frame` from start of frame to the end of the interframe space, stuff bits included: 11-bit 47..55+10n,
// 29-bit 67..80+10n.
std::uint32_t frame_bits(const CanFrame& frame) noexcept;

// CRC-15 (polynomial 0x4599) of the unstuffed bits from start of frame to the last data bit.
std::uint16_t frame_crc15(const CanFrame& frame) noexcept;

// Longest possible frame with 11-bit identifier and `bytes` 0..8 data bytes.
constexpr std::uint32_t worst_frame_bits(std::uint32_t bytes) noexcept { return 55 + 10 * bytes; }

// Arbitration field as a number: of two frames the lower one wins the wire.
std::uint32_t arbitration_key(const CanFrame& frame) noexcept;

}  // namespace liana::bus
