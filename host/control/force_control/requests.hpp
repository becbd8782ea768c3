// The requests of force control (docs/explanation/force-control.md) against the tables of robot and buses. lianad looks
// at them when they come, a mission's are looked at before it starts as far as they are known: in the same words.
#pragma once

#include <string_view>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/serial/mass_table.hpp"
#include "firmware_like/serial/push.hpp"
#include "host/api/server/arguments.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::force_control {

// A push as the request `push` asks for it, without a number. Throws RequestError: refused as require_torque_drives
// does, and without a wrist sensor in the bus table; out_of_range for what is outside the robot's table.
serial::Push push_of(const config::SerialRobotConfig& robot, const api::Arguments& fields);

// What the arm carries, as the request `payload` says. Throws RequestError out_of_range for what is no body.
serial::LinkMass payload_of(const api::Arguments& fields);
// The same of a cable arm, which takes it as a point mass. Throws RequestError bad_request for an inertia, out_of_range
// for what is no payload of such an arm.
cable::TipLoad tip_load_of(const api::Arguments& fields);

// Pushing and giving way need drives that follow torques. Throws RequestError refused.
void require_torque_drives(const config::SerialRobotConfig& robot);

// Somebody has to be there who is told to lock. Throws RequestError refused when the bus table has no adapter.
void require_adapter(const config::SerialRobotConfig& robot);

// Throws what of the above is true of the request `op`; others are no matter of force control.
void require_possible(const config::SerialRobotConfig& robot, std::string_view op, const api::Arguments& fields);

}  // namespace liana::force_control
