// The process data of wrist sensor and adapter as bytes (docs/explanation/force-control.md), little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_like/serial/sensors.hpp"

namespace liana::serial {

constexpr double kWristForceStep_N = 0.02;
constexpr double kWristTorqueStep_Nm = 0.01;
constexpr std::size_t kWristBytes = 8;    // of TPDO1 and of TPDO2
constexpr std::size_t kAdapterBytes = 8;  // of TPDO1
constexpr std::size_t kAdapterCommandBytes = 2;

// One half of a sample: TPDO1 has the force, TPDO2 the torque: x, y, z i16, sequence u8, status u8.
struct WristHalf {
  Vec3 value{};  // N or N.m
  std::uint8_t sequence = 0;
  WristStatus status = WristStatus::kFailed;
};

// Reads one half; false, with `out` untouched, unless there are exactly kWristBytes. A status that nobody knows is
// kFailed.
[[nodiscard]] bool decode_wrist_half(std::span<const std::uint8_t> data, double step, WristHalf& out) noexcept;

// Reads TPDO1 of the adapter: sequence, captured, latch, lock, three depths, spare; false, with `out` untouched, unless
// there are exactly kAdapterBytes. A state that nobody knows is kFailed. The age becomes 0.
[[nodiscard]] bool decode_adapter(std::span<const std::uint8_t> data, AdapterReading& out) noexcept;

// What the adapter may be told.
enum class AdapterCommand : std::uint8_t { kNone = 0, kLock = 1, kRelease = 2 };

// Data field of its RPDO1. A command counts once for every new sequence.
std::array<std::uint8_t, kAdapterCommandBytes> encode_adapter_command(AdapterCommand command,
                                                                      std::uint8_t sequence) noexcept;

}  // namespace liana::serial
