// A curve for the arm to follow, planned while a mission runs (host/planning/planner/follow/follow.hpp).
#pragma once

#include "host/base/json/json_fwd.hpp"

namespace liana::mission_runner {

// Plans from `request`: { from_deg, points (metres, base frame), margin_m }; `welcome` is lianad's first message, with
// robot, buses and scene. Gives { waypoints_deg, tip_off_m, curve_off_m, curve_off_segment, curve_off_along_m }. Throws
// std::runtime_error with what is wrong with the curve. Cost: about 50 ms for 100 waypoints, more past a scene.
Json follow_plan(const Json& welcome, const Json& request);

}  // namespace liana::mission_runner
