// The visual servo in requests and in the state message, the same for every arm.
#pragma once

#include "host/api/server/arguments.hpp"
#include "host/base/json/json_fwd.hpp"
#include "host/control/visual_servo/target_servo.hpp"

namespace liana::server {

// What `servo_target` asks for.
visual_servo::ServoRequest servo_request(const api::Arguments& fields);

// With which periods the base swings, of `move_jp`, `move_cp` and `servo_target`.
motion::Swings swings_of(const api::Arguments& fields);

// `servo` of the state (docs/reference/api.md).
Json servo_json(const visual_servo::ServoStatus& report);

}  // namespace liana::server
