#include "firmware_like/cable/arm/load_cell.hpp"

#include <cmath>

namespace liana::cable {
namespace {

double tension_N(const LoadCellParams& cell, const LoadCells& cells, std::size_t cable) noexcept {
  return cell.newtons_per_step[cable] * cells.steps[cable] - cell.zero_N[cable];
}

bool is_usable(const LoadCellParams& cell, const LoadCells& cells, std::size_t cable) noexcept {
  const CellSteps steps = cells.steps[cable];
  return cells.age_ticks[cable] <= kLoadCellAgeTicks && steps != kOverRange && steps != kUnderRange &&
         std::fabs(tension_N(cell, cells, cable)) <= cell.range_N;
}

bool is_at_odds(const LoadCellParams& cell, const LoadCells& cells, std::size_t cable, double torque_N,
                const LoadCellState& state) noexcept {
  return std::fabs(tension_N(cell, cells, cable) - torque_N) > cell.agree_N ||
         std::fabs(torque_N - state.torque_then_N[cable]) > kStuckShare * cell.agree_N;
}

void put_bit(std::uint32_t& mask, std::size_t bit, bool value) noexcept {
  mask = value ? mask | 1u << bit : mask & ~(1u << bit);
}

}  // namespace

double believed_tension_N(const RobotParams& table, const LoadCells& cells, std::size_t cable, double torque_N,
                          LoadCellState& state) noexcept {
  const bool changed = state.powered == 0 || cells.steps[cable] != state.steps_then[cable];
  if (changed) {
    state.steps_then[cable] = cells.steps[cable];
    state.torque_then_N[cable] = torque_N;
  }
  const bool usable = is_usable(table.load_cell, cells, cable);
  const bool was_at_odds = (state.usable >> cable & 1u) != 0 && (state.believed >> cable & 1u) == 0;
  const bool at_odds = reports_torque(table, cable) &&
                       ((was_at_odds && !changed) || is_at_odds(table.load_cell, cells, cable, torque_N, state));
  const bool believed = usable && (state.powered == 0 || !at_odds);
  put_bit(state.usable, cable, usable);
  put_bit(state.believed, cable, believed);
  return believed ? tension_N(table.load_cell, cells, cable) : torque_N;
}

void watch_load_cell(const RobotParams& table, WatchScope scope, std::int32_t cable, LoadCellState& state,
                     Watch& out) noexcept {
  const std::size_t c = as_index(cable);
  const bool usable = (state.usable >> c & 1u) != 0;
  const bool lost = !usable && (table.load_cell.goes_on == 0 || !reports_torque(table, c));
  out.debounced(lost, kLoadCellLostTicks, state.lost_ticks[c], FaultNumber::kLoadCellLost, cable);
  const bool doubted = usable && (state.believed >> c & 1u) == 0;
  out.debounced(doubted, kLoadCellDoubtTicks, state.doubt_ticks[c], FaultNumber::kLoadCellContradicts, cable);
  state.powered = scope.powered ? 1 : 0;
}

CellSteps steps_of(const RobotParams& table, std::size_t cable, double tension_N) noexcept {
  const double steps = (tension_N + table.load_cell.zero_N[cable]) / table.load_cell.newtons_per_step[cable];
  if (!(steps > kUnderRange)) return kUnderRange;
  if (steps >= kOverRange) return kOverRange;
  return narrow<CellSteps>(to_counts(steps).value);
}

}  // namespace liana::cable
