// `liana robot check` of a robot with a serial arm: poses that touch themselves, and how its locked base swings.
#pragma once

#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::cli {

// What JSON output has of it but its buses. `scene`: its payload is carried where swings are told with one.
Json checked_serial_robot(const config::SerialRobotConfig& robot, const config::SceneConfig& scene);

// Lines for `swings` of it.
void print_swings(const Json& swings);

}  // namespace liana::cli
