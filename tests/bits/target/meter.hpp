// What a target measures of a tick beside its result.
#pragma once

#include "firmware_like/controller.hpp"

namespace liana::bits {

// One tick; a target that can count does it here.
Outputs metered_tick(Controller& controller, const Inputs& inputs) noexcept;

// Writes what was counted, if anything; false when the disk refuses.
bool write_meter();

}  // namespace liana::bits
