#include "firmware_like/drive/pdo.hpp"

#include <cstddef>

namespace liana {
namespace {

constexpr std::uint8_t byte_of(std::uint32_t value, std::uint32_t position) noexcept {
  return static_cast<std::uint8_t>((value >> (8U * position)) & 0xFFU);
}

constexpr std::uint16_t read_u16(std::span<const std::uint8_t> data, std::size_t first) noexcept {
  return static_cast<std::uint16_t>(data[first] | (static_cast<std::uint32_t>(data[first + 1]) << 8U));
}

constexpr std::uint32_t read_u32(std::span<const std::uint8_t> data, std::size_t first) noexcept {
  return read_u16(data, first) | (static_cast<std::uint32_t>(read_u16(data, first + 2)) << 16U);
}

}  // namespace

std::array<std::uint8_t, kRpdo1Bytes> encode_rpdo1(const DriveCommand& command) noexcept {
  const auto target = static_cast<std::uint32_t>(command.target_counts);
  return {byte_of(command.controlword, 0),
          byte_of(command.controlword, 1),
          byte_of(target, 0),
          byte_of(target, 1),
          byte_of(target, 2),
          byte_of(target, 3)};
}

std::array<std::uint8_t, kTpdo1Bytes> encode_tpdo1(const Tpdo1& report) noexcept {
  const auto position = static_cast<std::uint32_t>(report.position_counts);
  const auto torque = static_cast<std::uint16_t>(report.torque_permille);
  return {byte_of(report.statusword, 0), byte_of(report.statusword, 1), byte_of(position, 0), byte_of(position, 1),
          byte_of(position, 2),          byte_of(position, 3),          byte_of(torque, 0),   byte_of(torque, 1)};
}

bool decode_rpdo1(std::span<const std::uint8_t> data, DriveCommand& command) noexcept {
  if (data.size() != static_cast<std::size_t>(kRpdo1Bytes)) return false;
  command.controlword = read_u16(data, 0);
  command.target_counts = static_cast<std::int32_t>(read_u32(data, 2));
  return true;
}

bool decode_tpdo1(std::span<const std::uint8_t> data, Tpdo1& report, bool has_torque) noexcept {
  if (data.size() != static_cast<std::size_t>(has_torque ? kTpdo1Bytes : kTpdo1BytesWithoutTorque)) return false;
  report.statusword = read_u16(data, 0);
  report.position_counts = static_cast<std::int32_t>(read_u32(data, 2));
  report.torque_permille = has_torque ? static_cast<std::int16_t>(read_u16(data, 6)) : std::int16_t{0};
  return true;
}

std::array<std::uint8_t, kTorqueRpdo1Bytes> encode_torque_rpdo1(const DriveCommand& command) noexcept {
  const auto torque = static_cast<std::uint16_t>(command.torque_permille);
  const auto rate = static_cast<std::uint32_t>(command.rate_counts_s);
  return {byte_of(command.controlword, 0),
          byte_of(command.controlword, 1),
          byte_of(torque, 0),
          byte_of(torque, 1),
          byte_of(rate, 0),
          byte_of(rate, 1),
          byte_of(rate, 2),
          byte_of(rate, 3)};
}

bool decode_torque_rpdo1(std::span<const std::uint8_t> data, DriveCommand& command) noexcept {
  if (data.size() != static_cast<std::size_t>(kTorqueRpdo1Bytes)) return false;
  command.controlword = read_u16(data, 0);
  command.torque_permille = static_cast<std::int16_t>(read_u16(data, 2));
  command.rate_counts_s = static_cast<std::int32_t>(read_u32(data, 4));
  return true;
}

bool decode_tpdo2(std::span<const std::uint8_t> data, std::int32_t& rate_counts_s) noexcept {
  if (data.size() != static_cast<std::size_t>(kTpdo2Bytes)) return false;
  rate_counts_s = static_cast<std::int32_t>(read_u32(data, 0));
  return true;
}

}  // namespace liana
