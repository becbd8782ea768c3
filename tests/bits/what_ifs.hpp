// Faults and commands planted into recorded Inputs: what would the core have done if, from this tick on, a drive, a bus
// or a client had behaved otherwise?
#pragma once

#include <cstdint>
#include <span>

#include "firmware_like/controller_io.hpp"

namespace liana::bits {

struct WhatIf {
  std::uint32_t ticks;  // how long it is followed
  // Changes the Inputs of tick `age` (0 = the first) with drive `drive`.
  void (*change)(Inputs& inputs, std::uint32_t age, std::size_t drive);
};

// For an arm that stands or moves with its drives enabled.
std::span<const WhatIf> what_ifs_enabled();

// For an arm whose drives are being enabled.
std::span<const WhatIf> what_ifs_enabling();

}  // namespace liana::bits
