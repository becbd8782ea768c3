// The process data of one drive as bytes (docs/reference/drives.md), little-endian: RPDO1 = 6040, 607A, or of a torque
// drive 6040, 6071, 60B1; TPDO1 = 6041, 6064, 6077; TPDO2, of a torque drive only, 606C.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_like/drive/drive_io.hpp"

namespace liana {

constexpr std::uint32_t kSyncCobId = 0x080;
constexpr std::uint32_t kRpdo1Base = 0x200;
constexpr std::uint32_t kTpdo1Base = 0x180;
constexpr std::uint32_t kTpdo2Base = 0x280;
constexpr std::int32_t kRpdo1Bytes = 6;
constexpr std::int32_t kTorqueRpdo1Bytes = 8;
constexpr std::int32_t kTpdo2Bytes = 4;
constexpr std::int32_t kTpdo1Bytes = 8;
constexpr std::int32_t kTpdo1BytesWithoutTorque = 6;

// COB-ID on which node 1..127 receives its command.
constexpr std::uint32_t rpdo1_cob_id(std::uint32_t node) noexcept { return kRpdo1Base + node; }
// COB-ID on which node 1..127 reports.
constexpr std::uint32_t tpdo1_cob_id(std::uint32_t node) noexcept { return kTpdo1Base + node; }

// What TPDO1 carries.
struct Tpdo1 {
  std::uint16_t statusword = 0;
  std::int32_t position_counts = 0;
  std::int16_t torque_permille = 0;  // of rated torque
};

// Data field of RPDO1.
std::array<std::uint8_t, kRpdo1Bytes> encode_rpdo1(const DriveCommand& command) noexcept;

// Data field of RPDO1 of a torque drive; the target position is not sent.
std::array<std::uint8_t, kTorqueRpdo1Bytes> encode_torque_rpdo1(const DriveCommand& command) noexcept;

// Data field of TPDO1, as a drive would send it.
std::array<std::uint8_t, kTpdo1Bytes> encode_tpdo1(const Tpdo1& report) noexcept;

// Reads RPDO1; false, with `command` untouched, unless there are exactly kRpdo1Bytes.
[[nodiscard]] bool decode_rpdo1(std::span<const std::uint8_t> data, DriveCommand& command) noexcept;

// Reads TPDO1; false, with `report` untouched, unless there are exactly kTpdo1Bytes, or kTpdo1BytesWithoutTorque of a
// drive that reports no torque, which is then 0.
[[nodiscard]] bool decode_tpdo1(std::span<const std::uint8_t> data, Tpdo1& report, bool has_torque = true) noexcept;

// Reads RPDO1 of a torque drive; false, with `command` untouched, unless there are exactly kTorqueRpdo1Bytes.
[[nodiscard]] bool decode_torque_rpdo1(std::span<const std::uint8_t> data, DriveCommand& command) noexcept;

// Reads TPDO2: 606C [counts/s]; false, with `rate` untouched, unless there are exactly kTpdo2Bytes.
[[nodiscard]] bool decode_tpdo2(std::span<const std::uint8_t> data, std::int32_t& rate_counts_s) noexcept;

}  // namespace liana
