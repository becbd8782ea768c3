// Convex bodies in the independent check (plan_check.hpp): libccd says whether a link touches, and nothing else.
#pragma once

#include <array>

#include "host/model/config/config.hpp"

namespace liana::planner {

// Distance of a link's axis from a convex body, or `enough` when it is not below that; within 5 um of the true one
// (libccd's own error, at distances of half a metre) where libccd decides. Found by halving: how much the axis can be
// swollen before libccd's GJK says that the two touch. What it cannot decide within its iterations counts as touching.
// An axis inside the body is 0 from it, less what its ball adds. Cost: about 25 questions of 1 us each, one where the
// link is far.
double convex_distance_m(const std::array<double, 3>& from, const std::array<double, 3>& to,
                         const config::SceneConvex& body, double enough);

}  // namespace liana::planner
