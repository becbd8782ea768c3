// Force control in requests and in the state message (docs/force-control.md).
#pragma once

#include "firmware_like/serial_controller.hpp"
#include "host/api/arguments.hpp"
#include "host/config/serial_robot.hpp"
#include "host/json/json.hpp"

namespace liana::daemon {

// A push as the request `push` asks for it, without a number. Throws RequestError out_of_range for what is outside the
// robot's table.
serial::Push push_of(const config::SerialRobotConfig& robot, const api::Arguments& fields);

// What the arm carries, as the request `payload` says. Throws RequestError out_of_range for what is no body.
serial::LinkMass payload_of(const api::Arguments& fields);

// `push`, `adapter` and `payload` of the state.
Json push_json(const serial::PushReport& push, double tick_s);
Json payload_json(const serial::LinkMass& payload_at_tip);
Json adapter_json(const serial::PushReport& push, double tick_s);

}  // namespace liana::daemon
