// What the links of a serial arm weigh, from its table: drawn as spheres and rods, or said link by link.
#pragma once

#include "firmware_like/serial/mass_table.hpp"
#include "firmware_like/serial/robot_params.hpp"
#include "host/model/config/field.hpp"

namespace liana::config {

// Reads `mass` (modules, booms, end effector), or `link` of every joint; refuses both, neither, a link at some joints
// only, and an inertia that no body can have. `joints` are those of `robot`, read before.
serial::MassTable read_masses(const Field& table, const serial::RobotParams& robot);

}  // namespace liana::config
