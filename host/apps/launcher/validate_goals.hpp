// Places that the steps of a mission send the tip to, as far as they are known before it starts.
#pragma once

#include <string>
#include <vector>

#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::launcher {

// How a step is called in messages: where it stands in the script, mission, number and name.
std::string step_where(const Json& mission, std::size_t i);

// Looks at every goal of the tip (`goal_tip` of a described step) with what is held on the way there, from where the
// step before leaves the arm, at first `start_deg`. Throws BadInput naming line, step and goal where no pose of the arm
// is there: it is nearer to the base, farther back, or turned farther than all joints together bend the arm (that it is
// no farther away than the arm is long, liana.preflight_robot has looked). What the goal search (solve/goal_ik.hpp)
// does not find either, and nothing proves, is the result: one text for each. Cost: 1 ms for a goal that is found, 20
// to 100 ms for another.
std::vector<std::string> look_at_tip_goals(const Json& mission, const config::RobotConfig& robot,
                                           const std::vector<double>& start_deg);

// The same for a serial arm, of which nothing is proved: what is not found is the result.
std::vector<std::string> look_at_tip_goals(const Json& mission, const config::SerialRobotConfig& robot,
                                           const std::vector<double>& start_deg);

}  // namespace liana::launcher
