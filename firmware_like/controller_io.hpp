// Everything that enters and leaves one tick: what every robot has, and what its arm adds.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware_like/command/telecommand.hpp"
#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/safety/cycle_inputs.hpp"
#include "firmware_like/safety/faults.hpp"
#include "firmware_like/safety/limits.hpp"
#include "firmware_like/safety/supervisor.hpp"

namespace liana {

template <class Arm>
struct Inputs : CycleInputs {
  Telecommand<typename Arm::Setpoint> telecommand{};  // kind kNone when nothing new was released
  [[no_unique_address]] typename Arm::Sensors sensors{};
};

// What leaves one tick of any robot.
struct CycleOutputs {
  std::uint64_t tick = 0;
  OperatingState state = OperatingState::kDisabled;
  StopCategory stop_category = StopCategory::kNone;
  std::uint32_t limits = 0;           // LimitBit
  std::uint8_t at_rest = 0;           // commanded motion has ended
  std::uint8_t homed = 0;             // the measured pose is trusted
  std::uint64_t active_sequence = 0;  // telecommand in force, 0 = none
  FaultList faults{};
  DriveCommands drive{};
};

template <class Arm>
struct Outputs : CycleOutputs, Arm::Report {};

}  // namespace liana
