// The packets of docs/reference/bus-protocol.md as structs. Little-endian, no padding.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "host/drives/bus/can_frame.hpp"

namespace liana::wire {

static_assert(std::endian::native == std::endian::little, "packets are copied as they lie in memory");

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kMaxPacketFrames = 256;
constexpr std::size_t kMaxBuses = 8;

enum class Type : std::uint8_t { kHello = 1, kWelcome = 2, kWake = 3, kYield = 4, kError = 5 };
enum class Role : std::uint8_t { kController = 0, kPlant = 1 };

// Flags of WAKE, of YIELD and of a frame in a WAKE.
constexpr std::uint8_t kWakeShutdown = 1;
constexpr std::uint8_t kWakeSlotStart = 2;
constexpr std::uint8_t kWakeSyncSeen = 4;
constexpr std::uint8_t kYieldWakeOnSync = 1;
constexpr std::uint8_t kYieldLeave = 2;
constexpr std::uint8_t kFrameRefused = 1;
constexpr std::uint8_t kFrameLink = 2;

struct Hello {
  Type type = Type::kHello;
  std::uint8_t version = kVersion;
  Role role = Role::kController;
  std::uint8_t zero = 0;
  std::array<char, 28> name{};
};
static_assert(sizeof(Hello) == 32);

struct WelcomeBus {
  std::uint32_t bitrate = 0;
  std::array<char, 12> name{};
};

struct Welcome {
  Type type = Type::kWelcome;
  std::uint8_t time_mode = 0;
  std::uint8_t bus_count = 0;
  std::uint8_t zero = 0;
  std::uint32_t period_us = 0;
  std::array<WelcomeBus, kMaxBuses> bus{};  // bus_count of them are sent
  std::size_t size() const { return offsetof(Welcome, bus) + bus_count * sizeof(WelcomeBus); }
};
static_assert(sizeof(Welcome) == 8 + 16 * kMaxBuses);

struct Frame {
  std::uint64_t time_us = 0;
  std::uint32_t id = 0;
  std::uint8_t bus = 0;
  std::uint8_t length = 0;
  std::uint8_t flags = 0;
  std::uint8_t zero = 0;
  std::array<std::uint8_t, 8> data{};
};
static_assert(sizeof(Frame) == 24);

struct Wake {
  Type type = Type::kWake;
  std::uint8_t flags = 0;
  std::uint16_t frame_count = 0;
  std::uint32_t slot = 0;
  std::uint64_t now_us = 0;
  std::array<Frame, kMaxPacketFrames> frame{};  // frame_count of them are sent
  std::size_t size() const { return offsetof(Wake, frame) + frame_count * sizeof(Frame); }
};
static_assert(offsetof(Wake, frame) == 16);

struct Yield {
  Type type = Type::kYield;
  std::uint8_t flags = 0;
  std::uint16_t frame_count = 0;
  std::uint32_t zero = 0;
  std::uint64_t until_us = 0;
  std::array<Frame, kMaxPacketFrames> frame{};  // frame_count of them are sent
  std::size_t size() const { return offsetof(Yield, frame) + frame_count * sizeof(Frame); }
};
static_assert(offsetof(Yield, frame) == 16);

constexpr std::size_t kHeaderBytes = 16;  // of WAKE and YIELD

// The frame without what only the bus needs.
inline bus::CanFrame to_can_frame(const Frame& frame) { return {frame.id, frame.length, frame.data, frame.time_us}; }

// The frame on `bus`, ready to be sent.
inline Frame to_wire_frame(int bus, const bus::CanFrame& frame) {
  return {frame.time_us, frame.id, static_cast<std::uint8_t>(bus), frame.length, 0, 0, frame.data};
}

}  // namespace liana::wire
