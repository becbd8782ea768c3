// A classical CAN frame as the host handles it.
#pragma once

#include <array>
#include <cstdint>

namespace liana::bus {

// Flags in CanFrame::id, as in linux/can.h.
constexpr std::uint32_t kCanExtendedFlag = 0x80000000;
constexpr std::uint32_t kCanRemoteFlag = 0x40000000;
constexpr std::uint32_t kCanErrorFlag = 0x20000000;
constexpr std::uint32_t kCanExtendedMask = 0x1FFFFFFF;
constexpr std::uint32_t kCanStandardMask = 0x7FF;

// One frame. `time_us` is set on received frames: end on the wire in virtual time, or time since open in real time.
struct CanFrame {
  std::uint32_t id = 0;     // bits 0..28 the identifier, bit 31 extended, bit 30 remote request, bit 29 error frame
  std::uint8_t length = 0;  // 0..8
  std::array<std::uint8_t, 8> data{};
  std::uint64_t time_us = 0;
};

}  // namespace liana::bus
