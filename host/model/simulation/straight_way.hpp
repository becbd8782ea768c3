// A straight motion in joint space as a sequence: gathers way as the table allows, goes on evenly, and stops.
#pragma once

#include "host/model/simulation/motion.hpp"
#include "host/model/simulation/serial_model.hpp"

namespace liana::simulation {

// From one pose to another in `duration_s` (> 0), a row every `interval_s`. The share of the way follows a trapezoid:
// its ends are as short as the table's accelerations let them be for every angle, at most half the time each.
JointSequence straight_way(const RobotParams& table, const ThetaVector& from_rad, const ThetaVector& to_rad,
                           double duration_s, double interval_s);
ToldRows<serial::JointVector> straight_way(const serial::RobotParams& table, const serial::JointVector& from_rad,
                                           const serial::JointVector& to_rad, double duration_s, double interval_s);

}  // namespace liana::simulation
