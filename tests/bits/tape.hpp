// The files between the programs of `./dev bits`. A tape is what every build of the core is fed with: one byte says
// what follows, fields are written as in host/storage/recording/serialise.hpp. All of a tape is of one kind of arm,
// which its first byte says.
#pragma once

#include <cstdint>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"

namespace liana::bits {

constexpr const char* kTapeFile = "tape.bits";  // in the working directory of bits_ticks
constexpr const char* kOutputsFile =
    "outputs.bits";  // written beside it: the Outputs of every tick of the tape, one after the other
constexpr const char* kMeterFile = "meter.bits";  // Cortex-M7: a Count of the calibration loop, then one of every tick

enum class Mark : std::uint8_t {
  kRobot = 1,        // the table of a cable arm follows: a new Controller
  kTick = 2,         // Inputs follow: one tick
  kKeep = 3,         // remember a copy of the Controller
  kReturn = 4,       // go on from that copy
  kSerialRobot = 5,  // the table of a serial arm follows: a new Controller
};

// The mark before a table of this kind of arm.
template <class Arm>
inline constexpr Mark kRobotMark = Mark::kRobot;
template <>
inline constexpr Mark kRobotMark<serial::SerialArm> = Mark::kSerialRobot;

struct Count {
  std::uint32_t clocks;       // of SysTick
  std::uint32_t stack_bytes;  // below the frame that calls tick
};

constexpr std::uint32_t kCalibrationInstructions = 2'000'000;  // of the calibration loop

}  // namespace liana::bits
