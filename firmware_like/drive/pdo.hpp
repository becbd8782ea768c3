// The process data of one drive as bytes (docs/drives.md): RPDO1 = 6040, 607A; TPDO1 = 6041, 6064, 6077; little-endian.
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
constexpr std::int32_t kRpdo1Bytes = 6;
constexpr std::int32_t kTpdo1Bytes = 8;

// Node id of a drive, 1-based; drive i (0-based) drives cable i.
constexpr std::uint32_t node_of_drive(std::size_t drive) noexcept { return static_cast<std::uint32_t>(drive + 1); }
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

// Data field of TPDO1, as a drive would send it.
std::array<std::uint8_t, kTpdo1Bytes> encode_tpdo1(const Tpdo1& report) noexcept;

// Reads RPDO1; false, with `command` untouched, unless there are exactly kRpdo1Bytes.
[[nodiscard]] bool decode_rpdo1(std::span<const std::uint8_t> data, DriveCommand& command) noexcept;

// Reads TPDO1; false, with `report` untouched, unless there are exactly kTpdo1Bytes.
[[nodiscard]] bool decode_tpdo1(std::span<const std::uint8_t> data, Tpdo1& report) noexcept;

}  // namespace liana
