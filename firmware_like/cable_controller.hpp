// The Controller of a cable arm, compiled once, and the short names of what goes in and out of it.
#pragma once

#include "firmware_like/cable/cable_arm.hpp"
#include "firmware_like/controller.hpp"

namespace liana {

extern template class Controller<cable::CableArm>;
static_assert(std::is_trivially_copyable_v<Controller<cable::CableArm>>);

namespace cable {

using Controller = liana::Controller<CableArm>;
using Inputs = liana::Inputs<CableArm>;
using Outputs = liana::Outputs<CableArm>;
using Telecommand = liana::Telecommand<Setpoint>;
static_assert(std::is_trivially_copyable_v<Inputs> && std::is_trivially_copyable_v<Outputs>);

}  // namespace cable

}  // namespace liana
