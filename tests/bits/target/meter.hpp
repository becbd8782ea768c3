// What a target measures of a tick beside its result.
#pragma once

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"

namespace liana::bits {

// One tick; a target that can count does it here.
template <class Arm>
Outputs<Arm> metered_tick(Controller<Arm>& controller, const Inputs<Arm>& inputs) noexcept;

// Ends the file of what was counted, if anything was; false when the disk has refused any of it.
bool close_meter();

}  // namespace liana::bits
