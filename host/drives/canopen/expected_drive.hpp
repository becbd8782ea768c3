// What a drive must be and what it is told at boot (docs/reference/drives.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/drives/canopen/cob_id.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/drive_type.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::canopen {

// What the arm asks of one drive, in increments of its encoder and seconds.
struct DriveProfile {
  double min_counts = 0.0;  // positions that it must be able to have
  double max_counts = 0.0;
  double counts_per_s = 0.0;  // fastest command
};

struct ExpectedDrive {
  std::size_t index = 0;  // 0-based
  int bus = 0;            // 0-based
  std::uint8_t node = 1;  // 1..126
  std::uint8_t axis = 1;  // of the node
  int segment = 0;        // from 1, of a cable arm
  config::DriveType type;
  // Must be found, unless the type knows better.
  std::uint32_t vendor = 0;             // 1018:1
  std::uint32_t product = 0;            // 1018:2
  std::uint32_t revision = 0;           // 1018:3
  std::uint32_t counts_per_turn = 0;    // 608F:1, per motor turn
  std::uint32_t gear_motor_turns = 1;   // 6091:1
  std::uint32_t gear_drum_turns = 1;    // 6091:2
  double rated_torque_mNm = 0.0;        // 6076, before the gear; a small motor has a fraction of one more
  std::optional<std::uint32_t> serial;  // 1018:4; without it, any: but the one found first has to stay
  DriveProfile demand;                  // 607D, 607F, 6080, 60C5, 6085
  // Is written.
  config::InterpolationPeriod period{};       // 60C2, the SYNC period
  std::uint16_t rpdo_deadline_ms = 0;         // 1400:5
  std::uint16_t heartbeat_ms = 100;           // 1017
  std::uint16_t master_timeout_ms = 300;      // 1016:1
  std::uint32_t following_window_counts = 0;  // 6065

  // COB-IDs of its process data.
  std::uint32_t command_id() const noexcept { return rpdo1_cob_id(node) + kAxisCobIds * (axis - 1U); }
  std::uint32_t report_id() const noexcept { return tpdo1_cob_id(node) + kAxisCobIds * (axis - 1U); }
  std::uint32_t rate_id() const noexcept { return kTpdo2Base + node + kAxisCobIds * (axis - 1U); }
};

// "drive 4 (node 4, segment 2)"
std::string name_of(const ExpectedDrive& drive);
// How many of `drives`, which are not empty, are axes of the first one's node: those at their begin.
std::size_t axes_of_first(std::span<const ExpectedDrive> drives) noexcept;

// One expectation per drive, in the order of the cables or joints. Throws std::runtime_error when a node is on no bus.
std::vector<ExpectedDrive> drive_expectations(const config::RobotConfig& robot, const config::BusesConfig& buses);
std::vector<ExpectedDrive> drive_expectations(const config::SerialRobotConfig& robot, const config::BusesConfig& buses);

}  // namespace liana::canopen
