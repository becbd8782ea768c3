// The CiA 402 drive state machine as seen by the master: what a statusword means, and which controlword leads on.
#pragma once

#include <array>
#include <cstdint>

namespace liana {

// States of CiA 402 in the order of its figure; kUnknown is a statusword that matches none of them.
enum class DriveState : std::uint8_t {
  kUnknown = 0,
  kNotReadyToSwitchOn = 1,
  kSwitchOnDisabled = 2,
  kReadyToSwitchOn = 3,
  kSwitchedOn = 4,
  kOperationEnabled = 5,
  kQuickStopActive = 6,
  kFaultReactionActive = 7,
  kFault = 8,
};
constexpr std::int32_t kDriveStateCount = 9;

// Where a drive should end up; it is led there one transition at a time.
enum class DriveGoal : std::uint8_t {
  kDisabled = 0,          // no torque, brake closed: switch on disabled
  kSwitchedOn = 1,        // powered without torque, brake closed
  kOperationEnabled = 2,  // follows 607A, brake open
  kQuickStop = 3,         // stops on its own ramp (605A = 2), then brake, then switch on disabled
  kFaultReset = 4,        // leaves Fault, otherwise as kDisabled
};
constexpr std::int32_t kDriveGoalCount = 5;

// Controlwords (6040) of the commands of CiA 402.
constexpr std::uint16_t kDisableVoltage = 0x0000;
constexpr std::uint16_t kQuickStopCommand = 0x0002;
constexpr std::uint16_t kShutdown = 0x0006;
constexpr std::uint16_t kSwitchOn = 0x0007;
constexpr std::uint16_t kEnableOperation = 0x000F;
constexpr std::uint16_t kFaultResetBit = 0x0080;

// The state for every value of the bits that decide it: decoding is asked several times per drive and tick.
extern const std::array<DriveState, 128> kStateOfBits;

// State that a statusword (6041) shows; exactly one for each of the 65 536 values, kUnknown where CiA 402 defines none.
inline DriveState decode(std::uint16_t statusword) noexcept { return kStateOfBits[statusword & 0x7F]; }

// Controlword that takes a drive in `state` one transition towards `goal`. Fault reset acts on the rising edge of bit
// 7, so while the drive stays in Fault the bit alternates with what was sent before: `previous_controlword`.
std::uint16_t controlword_for(DriveState state, DriveGoal goal, std::uint16_t previous_controlword) noexcept;

// True when the drive produces torque with its brake open (Operation enabled, Quick stop active, Fault reaction
// active).
constexpr bool has_torque(DriveState state) noexcept {
  return state == DriveState::kOperationEnabled || state == DriveState::kQuickStopActive ||
         state == DriveState::kFaultReactionActive;
}

// True when the drive is known to be without power: Not ready, Switch on disabled, Ready to switch on or Fault.
constexpr bool is_off(DriveState state) noexcept {
  return state == DriveState::kNotReadyToSwitchOn || state == DriveState::kSwitchOnDisabled ||
         state == DriveState::kReadyToSwitchOn || state == DriveState::kFault;
}

// Name as the API prints it, e.g. "operation_enabled"; never null.
const char* drive_state_name(DriveState state) noexcept;

}  // namespace liana
