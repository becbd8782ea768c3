// Identifiers of the predefined connection set (CiA 301) and what the drives and the master use of it
// (docs/reference/drives.md).
#pragma once

#include <cstdint>

#include "firmware_like/drive/pdo.hpp"

namespace liana::canopen {

constexpr std::uint8_t kMasterNode = 127;

constexpr std::uint32_t kNmtId = 0x000;
constexpr std::uint32_t kEmergencyBase = 0x080;
constexpr std::uint32_t kTpdo1Base = 0x180;
constexpr std::uint32_t kRpdo1Base = 0x200;
constexpr std::uint32_t kSdoResponseBase = 0x580;
constexpr std::uint32_t kSdoRequestBase = 0x600;
constexpr std::uint32_t kHeartbeatBase = 0x700;

// Process data of a node's axis 2 have the identifiers of its axis 1 and so much more: those of PDOs 3 and 4 of the
// predefined set, so that no two PDOs of a bus have the same.
constexpr std::uint32_t kAxisCobIds = 0x200;

// Where an object of axis 1 is on another axis: objects of CiA 402 0x800 further, PDOs 64 numbers. What the whole node
// has, and the maker's own objects, stay.
constexpr std::uint16_t on_axis(std::uint16_t index, std::uint8_t axis) noexcept {
  const auto further = static_cast<std::uint16_t>(axis - 1);
  if (index >= 0x6000 && index < 0x6800) return static_cast<std::uint16_t>(index + 0x800 * further);
  if (index >= 0x1400 && index < 0x1C00 && (index & 0x1FF) < 0x40)
    return static_cast<std::uint16_t>(index + 0x40 * further);
  return index;
}

constexpr std::uint16_t kModeOfOperation = 0x6060;
constexpr std::uint16_t kModeDisplay = 0x6061;  // the mode that the drive is in

// NMT commands.
constexpr std::uint8_t kNmtStart = 0x01;
constexpr std::uint8_t kNmtStop = 0x02;
constexpr std::uint8_t kNmtPreOperational = 0x80;
constexpr std::uint8_t kNmtResetNode = 0x81;
constexpr std::uint8_t kNmtResetCommunication = 0x82;

// NMT states as in heartbeats.
constexpr std::uint8_t kStateBootUp = 0x00;
constexpr std::uint8_t kStateStopped = 0x04;
constexpr std::uint8_t kStateOperational = 0x05;
constexpr std::uint8_t kStatePreOperational = 0x7F;
constexpr std::uint8_t kNmtStateMask = 0x7F;  // bit 7 is the toggle bit of node guarding

// What kind of frame an identifier stands for.
enum class FrameKind : std::uint8_t {
  kNmt,
  kSync,
  kEmergency,
  kTpdo1,
  kRpdo1,
  kSdoResponse,
  kSdoRequest,
  kHeartbeat,
  kOther
};

// Kind, node (0 where there is none) and axis of an identifier.
struct FrameRoute {
  FrameKind kind = FrameKind::kOther;
  std::uint8_t node = 0;
  std::uint8_t axis = 1;  // of a PDO
};

// Reads an identifier as received (flags included; extended and remote frames are kOther).
constexpr FrameRoute route(std::uint32_t id) noexcept {
  if (id > 0x7FF) return {};
  const auto node = static_cast<std::uint8_t>(id & 0x7F);
  if (id == kNmtId) return {FrameKind::kNmt, 0};
  if (id == kSyncCobId) return {FrameKind::kSync, 0};
  if (node == 0) return {};
  switch (id & 0x780) {
    case kEmergencyBase:
      return {FrameKind::kEmergency, node};
    case kTpdo1Base:
      return {FrameKind::kTpdo1, node};
    case kRpdo1Base:
      return {FrameKind::kRpdo1, node};
    case kTpdo1Base + kAxisCobIds:
      return {FrameKind::kTpdo1, node, 2};
    case kRpdo1Base + kAxisCobIds:
      return {FrameKind::kRpdo1, node, 2};
    case kSdoResponseBase:
      return {FrameKind::kSdoResponse, node};
    case kSdoRequestBase:
      return {FrameKind::kSdoRequest, node};
    case kHeartbeatBase:
      return {FrameKind::kHeartbeat, node};
    default:
      return {};
  }
}

}  // namespace liana::canopen
