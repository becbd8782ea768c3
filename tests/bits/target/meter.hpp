// What a target measures of a tick beside its result.
#pragma once

#include "firmware_like/cable_controller.hpp"

namespace liana::bits {

// One tick; a target that can count does it here.
cable::Outputs metered_tick(cable::Controller& controller, const cable::Inputs& inputs) noexcept;

// Ends the file of what was counted, if anything was; false when the disk has refused any of it.
bool close_meter();

}  // namespace liana::bits
