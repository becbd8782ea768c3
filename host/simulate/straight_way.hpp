// A straight motion in joint space as a sequence: gathers way as the table allows, goes on evenly, and stops.
#pragma once

#include "host/simulate/motion.hpp"

namespace liana::simulate {

// Sequence from one pose to another in `duration_s` (> 0), a row every `interval_s`. The share of the way follows a
// trapezoid: its ends are as short as the table's acceleration lets them be for the angle that goes farthest, at most
// half the time each.
JointSequence straight_way(const RobotTable& table, const ThetaVector& from_rad, const ThetaVector& to_rad,
                           double duration_s, double interval_s);

}  // namespace liana::simulate
