// The Controller of a cable arm, compiled once.
#pragma once

#include "firmware_like/cable/cable_arm.hpp"
#include "firmware_like/controller.hpp"

namespace liana {

extern template class Controller<CableArm>;
static_assert(std::is_trivially_copyable_v<Controller<CableArm>>);
static_assert(std::is_trivially_copyable_v<Inputs<CableArm>> && std::is_trivially_copyable_v<Outputs<CableArm>>);

}  // namespace liana
