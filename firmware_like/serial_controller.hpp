// The Controller of a serial arm, compiled once, and the short names of what goes in and out of it.
#pragma once

#include "firmware_like/controller.hpp"
#include "firmware_like/serial/serial_arm.hpp"

namespace liana {

extern template class Controller<serial::SerialArm>;
static_assert(Arm<serial::SerialArm>);
static_assert(std::is_trivially_copyable_v<Controller<serial::SerialArm>>);

namespace serial {

using Controller = liana::Controller<SerialArm>;
using Inputs = liana::Inputs<SerialArm>;
using Outputs = liana::Outputs<SerialArm>;
using Telecommand = liana::Telecommand<Setpoint>;
static_assert(std::is_trivially_copyable_v<Inputs> && std::is_trivially_copyable_v<Outputs>);

}  // namespace serial

}  // namespace liana
