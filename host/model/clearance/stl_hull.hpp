// The hull of what an STL file holds: how a scene gets the shape of a part that was drawn elsewhere.
#pragma once

#include <string>
#include <vector>

#include "host/model/config/config.hpp"

namespace liana::clearance {

constexpr std::size_t kMaxTriangles = 200000;

// Of the size of a body (the longest side of its box): so far a hull with too many corners may be moved outwards.
constexpr double kMaxWidening = 0.02;

// Corners of a hull of all triangles in the file (text or binary STL), in its units and frame: every point of the file
// is within 1e-9 of their hull. With more than config::kMaxHullPoints corners it is simplified outwards: none of its
// corners lies more than kMaxWidening of the size outside of the triangles' own hull. Throws std::runtime_error with
// what is wrong and what to do when the file cannot be read, is no STL, is cut off, has no or too many triangles, holds
// no number, or cannot be simplified so. Takes up to a second, for a hull that is simplified some seconds.
std::vector<Vec3> stl_hull(const std::string& path);

}  // namespace liana::clearance
