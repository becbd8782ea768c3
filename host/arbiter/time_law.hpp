// How fast planned moves go: minimum-jerk laws from rest to rest.
#pragma once

#include "firmware_like/operator_input/tip_filter.hpp"

namespace liana::arbiter {

// Share of the limits that planned moves use; the rest is for the filters that follow them.
constexpr double kMoveShare = 0.9;
FilterBounds share_of(const FilterBounds& bounds);

// Position for time share 0..1 (clamped): 0..1 with velocity and acceleration zero at both ends.
double minimum_jerk(double share);

// Shortest duration [s] of a minimum-jerk motion over a way (>= 0, in the bounds' unit) that stays below a speed; below
// an acceleration; below all three bounds.
double time_for_speed(double way, double speed);
double time_for_accel(double way, double accel);
double time_within(double way, const FilterBounds& bounds);

}  // namespace liana::arbiter
