// Load cells between drums and first discs: what they say, and when it is believed in place of the drives' torque.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"

namespace liana::cable {

constexpr std::uint16_t kLoadCellAgeTicks = kFeedbackAgeTicks;  // a reading may be missing for so long
constexpr std::uint16_t kLoadCellLostTicks = 25;                // without a usable reading in a row: the cell is lost
constexpr std::uint16_t kLoadCellDoubtTicks = 5;  // at odds with the torque in a row: one of both is wrong
constexpr double kStuckShare = 0.25;              // of agree_N: a cell that does not feel so much is stuck
constexpr std::uint16_t kNeverRead = 0xFFFF;

// A cell's reading on the wire (docs/reference/drives.md#load-cells): its full scale in steps, and what is no reading.
using CellSteps = std::int16_t;
constexpr CellSteps kOverRange = std::numeric_limits<CellSteps>::max();
constexpr CellSteps kUnderRange = std::numeric_limits<CellSteps>::min();

// What the cells said last; ages count ticks since then.
struct LoadCells {
  std::array<CellSteps, kMaxCables> steps{};
  std::array<std::uint16_t, kMaxCables> age_ticks = [] {
    std::array<std::uint16_t, kMaxCables> never{};
    never.fill(kNeverRead);
    return never;
  }();
};

// What is remembered of the cells between ticks.
struct LoadCellState {
  std::uint32_t usable = 0, believed = 0;               // bit i: the reading of cable i, in this tick
  std::uint8_t powered = 0;                             // drives have torque, which says something
  std::array<std::uint16_t, kMaxCables> lost_ticks{};   // in a row without a usable reading
  std::array<std::uint16_t, kMaxCables> doubt_ticks{};  // in a row at odds with the torque
  std::array<CellSteps, kMaxCables> steps_then{};       // when the reading changed last,
  CableVector torque_then_N{};                          // and tension by torque then
};

inline bool has_load_cell(const RobotParams& table, std::size_t cable) noexcept {
  return table.load_cell.newtons_per_step[cable] > 0.0;
}

// Whether the drive of a cable reports torque (6077).
inline bool reports_torque(const RobotParams& table, std::size_t cable) noexcept {
  return (table.no_torque >> cable & 1u) == 0;
}

// Bit i: cable i has a load cell.
inline std::uint32_t cables_with_cells(const RobotParams& table) noexcept {
  std::uint32_t mask = 0;
  for (std::int32_t c = 0; c < table.cable_count(); ++c)
    if (has_load_cell(table, as_index(c))) mask |= 1u << as_index(c);
  return mask;
}

// Tension of a cable with a cell, which alone counts where the drive reports no torque: the cell's; the torque's,
// `torque_N`, where the reading is not usable or, of drives with power, at odds with it: further off than
// LoadCellParams::agree_N, or the very same while the torque went on by a quarter of that.
double believed_tension_N(const RobotParams& table, const LoadCells& cells, std::size_t cable, double torque_N,
                          LoadCellState& state) noexcept;

// Faults of one cell: 5010 lost (unless the table lets the arm go on by torque), 5011 at odds with the torque.
void watch_load_cell(const RobotParams& table, WatchScope scope, std::int32_t cable, LoadCellState& state,
                     Watch& out) noexcept;

// Reading of a tension, in steps; beyond the range of the wire it is over or under range.
CellSteps steps_of(const RobotParams& table, std::size_t cable, double tension_N) noexcept;

}  // namespace liana::cable
