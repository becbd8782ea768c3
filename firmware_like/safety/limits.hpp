// Limits that act on a motion never do so silently: each names itself.
#pragma once

#include <cstdint>

namespace liana {

// Bits of CycleOutputs::limits; the numbers are in recordings and never change meaning.
enum LimitBit : std::uint32_t {
  kLimitTipSpeed = 1u << 0,
  kLimitTipAccel = 1u << 1,
  kLimitTheta = 1u << 2,  // a joint angle stands at its limit
  kLimitThetaRate = 1u << 3,
  kLimitThetaAccel = 1u << 4,
  kLimitCableSpeed = 1u << 5,
  kLimitTensionFloor = 1u << 6,
  kLimitTensionCeiling = 1u << 7,
  kLimitSingular = 1u << 8,
  kLimitGate = 1u << 9,
  kLimitExpired = 1u << 10,  // no valid telecommand: the arm holds
  kLimitReach = 1u << 11,    // the target is farther away than the arm is long
};

}  // namespace liana
