// Faults and commands planted into recorded Inputs: what would the core have done if, from this tick on, a drive, a bus
// or a client had behaved otherwise?
#pragma once

#include <cstdint>
#include <span>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"

namespace liana::bits {

template <class Arm>
struct WhatIf {
  std::uint32_t ticks;  // how long it is followed
  // Changes the Inputs of tick `age` (0 = the first) with drive `drive`.
  void (*change)(Inputs<Arm>& inputs, std::uint32_t age, std::size_t drive);
};

// For an arm that stands or moves with its drives enabled.
template <class Arm>
std::span<const WhatIf<Arm>> what_ifs_enabled();
template <>
std::span<const WhatIf<cable::CableArm>> what_ifs_enabled();
template <>
std::span<const WhatIf<serial::SerialArm>> what_ifs_enabled();

// For an arm whose drives are being enabled.
template <class Arm>
std::span<const WhatIf<Arm>> what_ifs_enabling();
template <>
std::span<const WhatIf<cable::CableArm>> what_ifs_enabling();
template <>
std::span<const WhatIf<serial::SerialArm>> what_ifs_enabling();

}  // namespace liana::bits
