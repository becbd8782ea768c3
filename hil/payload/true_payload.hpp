// What payload, adapter, gears and base really are, as opposed to what the tables say: drawn from the seed.
#pragma once

#include <cstdint>

#include "hil/config/payload_config.hpp"
#include "hil/serial/pin_contact.hpp"
#include "hil/serial/true_arm.hpp"

namespace liana::bench {

// Shares of the table's figures, all assumed: dry friction 0.5 to 1.9, stiffness of gears 0.7 to 1.3, of the locked
// base 0.8 to 1.2.
SerialRobotConfig true_joints(const SerialRobotConfig& robot, std::uint64_t seed);

// Mass and inertia 0.6 to 2.0 of the table's.
PayloadConfig true_payload(const PayloadConfig& payload, std::uint64_t seed);

// Friction of pins 0.05 to 0.3, their walls 1e4 to 2e5 N/m, the capture spring 0.8 to 1.15 of its stiffness.
AdapterParams true_adapter(std::uint64_t seed);

// By how much a payload that begins on the arm is beside the adapter's axis, and turned: in the plate's frame, within
// `start_lateral_m` along x and along y, `start_tilt_rad` in all.
Pose start_offset(const PayloadConfig& payload, std::uint64_t seed);

}  // namespace liana::bench
