// The hull of what an STL file holds: how a scene gets the shape of a part that was drawn elsewhere.
#pragma once

#include <string>
#include <vector>

#include "host/model/config/config.hpp"

namespace liana::clearance {

constexpr std::size_t kMaxTriangles = 200000;

// Corners of the hull of all triangles in the file (text or binary STL), in its units and frame: every point of the
// file is within 1e-9 of their hull. Throws std::runtime_error "allowed ...: what to do" when the file is no STL, holds
// no number or too many triangles, or its hull has more than config::kMaxHullPoints corners. Takes up to a second.
std::vector<Vec3> stl_hull(const std::string& path);

}  // namespace liana::clearance
