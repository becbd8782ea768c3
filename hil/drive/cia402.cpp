#include "hil/drive/cia402.hpp"

namespace liana::bench {

namespace {

using enum PowerState;
using enum PowerCommand;

struct CommandBits {
  std::uint16_t mask;
  std::uint16_t value;
  PowerCommand command;
};

constexpr CommandBits kCommands[] = {
    {0x02, 0x00, kDisableVoltage}, {0x06, 0x02, kQuickStop},       {0x07, 0x06, kShutdown},
    {0x0F, 0x07, kSwitchOn},       {0x0F, 0x0F, kEnableOperation},
};

struct Transition {
  PowerState from;
  PowerCommand command;
  PowerState to;
};

// CiA 402 transition numbers at the right; 13 to 15 (fault) and 16 (not supported: 605A = 2) are not commands.
constexpr Transition kTransitions[] = {
    {kSwitchOnDisabled, kShutdown, kReadyToSwitchOn},         // 2
    {kReadyToSwitchOn, kSwitchOn, kSwitchedOn},               // 3
    {kReadyToSwitchOn, kEnableOperation, kSwitchedOn},        // 3; 4 follows with the next controlword
    {kSwitchedOn, kEnableOperation, kOperationEnabled},       // 4
    {kOperationEnabled, kSwitchOn, kSwitchedOn},              // 5
    {kSwitchedOn, kShutdown, kReadyToSwitchOn},               // 6
    {kReadyToSwitchOn, kDisableVoltage, kSwitchOnDisabled},   // 7
    {kReadyToSwitchOn, kQuickStop, kSwitchOnDisabled},        // 7
    {kOperationEnabled, kShutdown, kReadyToSwitchOn},         // 8
    {kOperationEnabled, kDisableVoltage, kSwitchOnDisabled},  // 9
    {kSwitchedOn, kDisableVoltage, kSwitchOnDisabled},        // 10
    {kSwitchedOn, kQuickStop, kSwitchOnDisabled},             // 10
    {kOperationEnabled, kQuickStop, kQuickStopActive},        // 11
    {kQuickStopActive, kDisableVoltage, kSwitchOnDisabled},   // 12
};

}  // namespace

PowerCommand decode_command(std::uint16_t controlword) {
  for (const auto& bits : kCommands)
    if ((controlword & bits.mask) == bits.value) return bits.command;
  return kNone;
}

PowerState next_state(PowerState state, PowerCommand command) {
  for (const auto& transition : kTransitions)
    if (transition.from == state && transition.command == command) return transition.to;
  return state;
}

std::uint16_t state_bits(PowerState state) {
  switch (state) {
    case kReadyToSwitchOn:
      return 0x21;
    case kSwitchedOn:
      return 0x23;
    case kOperationEnabled:
      return 0x27;
    case kQuickStopActive:
      return 0x07;
    case kFaultReactionActive:
      return 0x0F;
    case kFault:
      return 0x08;
    case kSwitchOnDisabled:
      break;
  }
  return 0x40;
}

}  // namespace liana::bench
