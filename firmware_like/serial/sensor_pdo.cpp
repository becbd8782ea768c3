#include "firmware_like/serial/sensor_pdo.hpp"

namespace liana::serial {
namespace {

double read_i16(std::span<const std::uint8_t> data, std::size_t first) noexcept {
  const auto bits = static_cast<std::uint16_t>(data[first] | (static_cast<std::uint32_t>(data[first + 1]) << 8U));
  return static_cast<double>(static_cast<std::int16_t>(bits));
}

CatchState catch_state(std::uint8_t byte) noexcept {
  return byte <= 3 ? static_cast<CatchState>(byte) : CatchState::kFailed;
}

}  // namespace

bool decode_wrist_half(std::span<const std::uint8_t> data, double step, WristHalf& out) noexcept {
  if (data.size() != kWristBytes) return false;
  out.value = {step * read_i16(data, 0), step * read_i16(data, 2), step * read_i16(data, 4)};
  out.sequence = data[6];
  out.status = data[7] <= 2 ? static_cast<WristStatus>(data[7]) : WristStatus::kFailed;
  return true;
}

bool decode_adapter(std::span<const std::uint8_t> data, AdapterReading& out) noexcept {
  if (data.size() != kAdapterBytes) return false;
  out.sequence = data[0];
  out.captured = data[1] == 1 ? 1 : 0;
  out.latch = catch_state(data[2]);
  out.lock = catch_state(data[3]);
  out.depth_01mm = {data[4], data[5], data[6]};
  out.age_ticks = 0;
  return true;
}

std::array<std::uint8_t, kAdapterCommandBytes> encode_adapter_command(AdapterCommand command,
                                                                      std::uint8_t sequence) noexcept {
  return {static_cast<std::uint8_t>(command), sequence};
}

}  // namespace liana::serial
