// The points that people give for a curve to follow.
#pragma once

#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/model/config/field.hpp"

namespace liana::planner {

// From a list of [x, y, z] in the base frame, m: 2 to kMaxFollowPoints, neighbours at least 1 mm apart. Throws
// std::runtime_error, which names the point, counted from 1.
std::vector<Vec3> curve_points(const config::Field& list);

}  // namespace liana::planner
