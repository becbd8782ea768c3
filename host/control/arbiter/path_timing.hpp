// One time law over a whole path, from rest to rest and without a stop between.
#pragma once

#include <vector>

#include "host/control/arbiter/blended_path.hpp"
#include "host/control/arbiter/speed_zone.hpp"

namespace liana::arbiter {

// Place on the path [rad] at the end of each command interval; the last is its end. As fast as joint rates (and
// `rate_rad_s`), the joints' acceleration for moves, drives, tip speed (in `zone` the zone's) and tip rate allow, with
// steps of acceleration smoothed over a second; kMoveShare of each but the acceleration. The finished motion is
// measured, and slowed down as a whole until it keeps them all. Cost: some forward kinematics per interval.
template <class Arm>
std::vector<double> path_timing(const typename Arm::Table& table, const SpeedZone& zone, const BlendedPath<Arm>& path,
                                double rate_rad_s);

}  // namespace liana::arbiter
