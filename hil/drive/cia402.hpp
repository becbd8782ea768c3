// The CiA 402 power state machine as tables.
#pragma once

#include <cstdint>

namespace liana::bench {

enum class PowerState : std::uint8_t {
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault
};

enum class PowerCommand : std::uint8_t { kNone, kDisableVoltage, kQuickStop, kShutdown, kSwitchOn, kEnableOperation };

// What a controlword's bits 0 to 3 ask for (bit 7, fault reset, is an edge and the drive's business).
PowerCommand decode_command(std::uint16_t controlword);
// The state a command leads to; the same state where the standard has no transition.
PowerState next_state(PowerState state, PowerCommand command);
// Bits 0..3, 5 and 6 of the statusword.
std::uint16_t state_bits(PowerState state);

}  // namespace liana::bench
