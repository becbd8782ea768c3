// Serial arms as MuJoCo XML: hinges, and bodies that are spheres and rods or have the inertia that the table says.
#pragma once

#include <string>

#include "hil/config/serial_config.hpp"

namespace liana::bench {

// The arm alone, its rotors as armature of the hinges; the body at its end is named "tip".
std::string make_serial_mjcf(const SerialRobotConfig& robot);

// The arm on the arm that carries it, if any (its hinges come first), without rotors; `payload` is fixed to the tip, in
// the tip's frame, as the body "payload"; one without mass: none.
std::string make_mjcf_with_base(const SerialRobotConfig& robot, const BodyConfig& payload);

}  // namespace liana::bench
