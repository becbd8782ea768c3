#include "firmware_like/drive/cia402.hpp"

#include <array>
#include <cstddef>

namespace liana {
namespace {

struct StatusRow {
  std::uint16_t mask;
  std::uint16_t value;
  DriveState state;
};

// CiA 402, statusword coding: bits 6, 5, 3, 2, 1, 0 (bit 5, quick stop, is not looked at where the standard prints x).
constexpr std::array<StatusRow, 8> kStatusTable{{
    {0x004F, 0x0000, DriveState::kNotReadyToSwitchOn},   // x0xx 0000
    {0x004F, 0x0040, DriveState::kSwitchOnDisabled},     // x1xx 0000
    {0x006F, 0x0021, DriveState::kReadyToSwitchOn},      // x01x 0001
    {0x006F, 0x0023, DriveState::kSwitchedOn},           // x01x 0011
    {0x006F, 0x0027, DriveState::kOperationEnabled},     // x01x 0111
    {0x006F, 0x0007, DriveState::kQuickStopActive},      // x00x 0111
    {0x004F, 0x000F, DriveState::kFaultReactionActive},  // x0xx 1111
    {0x004F, 0x0008, DriveState::kFault},                // x0xx 1000
}};

using GoalRow = std::array<std::uint16_t, kDriveGoalCount>;

// Rows as in the figure of CiA 402, one column per goal; (n) is the transition the command asks for, (-) none.
// Quick stop active is left by the drive itself (12); transition 16 is optional and never used: a motion that a drive
// broke off is not resumed behind the supervisor's back.
// clang-format off
constexpr std::array<GoalRow, kDriveStateCount> kControlTable{{
    // disabled                switched on          operation enabled        quick stop                  fault reset
    {kDisableVoltage,          kDisableVoltage,     kDisableVoltage,         kDisableVoltage,            kDisableVoltage},          // unknown
    {kDisableVoltage,          kDisableVoltage,     kDisableVoltage,         kDisableVoltage,            kDisableVoltage},          // not ready: (1) by itself
    {kDisableVoltage,          kShutdown /*(2)*/,   kShutdown /*(2)*/,       kDisableVoltage,            kDisableVoltage},          // switch on disabled
    {kDisableVoltage /*(7)*/,  kSwitchOn /*(3)*/,   kSwitchOn /*(3)*/,       kQuickStopCommand /*(7)*/,  kDisableVoltage /*(7)*/},  // ready to switch on
    {kDisableVoltage /*(10)*/, kSwitchOn /*(-)*/,   kEnableOperation /*(4)*/, kQuickStopCommand /*(10)*/, kDisableVoltage /*(10)*/}, // switched on
    {kDisableVoltage /*(9)*/,  kSwitchOn /*(5)*/,   kEnableOperation /*(-)*/, kQuickStopCommand /*(11)*/, kDisableVoltage /*(9)*/},  // operation enabled
    {kDisableVoltage /*(12)*/, kQuickStopCommand,   kQuickStopCommand,       kQuickStopCommand,          kDisableVoltage /*(12)*/}, // quick stop active
    {kDisableVoltage,          kDisableVoltage,     kDisableVoltage,         kDisableVoltage,            kDisableVoltage},          // fault reaction: (14) by itself
    {kDisableVoltage,          kDisableVoltage,     kDisableVoltage,         kDisableVoltage,            kFaultResetBit /*(15)*/},  // fault
}};
// clang-format on

constexpr std::array<const char*, kDriveStateCount> kStateNames{
    "unknown",     "not_ready_to_switch_on", "switch_on_disabled", "ready_to_switch_on",
    "switched_on", "operation_enabled",      "quick_stop_active",  "fault_reaction_active",
    "fault",
};

constexpr std::size_t row_of(DriveState state) noexcept {
  const auto row = static_cast<std::size_t>(state);
  return row < kStateNames.size() ? row : 0;
}

}  // namespace

constinit const std::array<DriveState, 128> kStateOfBits = [] {
  std::array<DriveState, 128> states{};
  for (std::size_t bits = 0; bits < states.size(); ++bits) {
    states[bits] = DriveState::kUnknown;
    for (const StatusRow& row : kStatusTable) {
      if ((bits & row.mask) == row.value) states[bits] = row.state;  // rows exclude each other
    }
  }
  return states;
}();

std::uint16_t controlword_for(DriveState state, DriveGoal goal, std::uint16_t previous_controlword) noexcept {
  const auto column = static_cast<std::size_t>(goal);
  if (column >= kControlTable[0].size()) return kDisableVoltage;
  const std::uint16_t word = kControlTable[row_of(state)][column];
  const bool edge_is_spent = (word & kFaultResetBit) != 0 && (previous_controlword & kFaultResetBit) != 0;
  return edge_is_spent ? kDisableVoltage : word;
}

const char* drive_state_name(DriveState state) noexcept { return kStateNames[row_of(state)]; }

}  // namespace liana
