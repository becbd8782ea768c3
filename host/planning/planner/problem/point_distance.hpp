// Distance of a point from an obstacle with first and second derivatives by the point.
#pragma once

#include <array>
#include <cstdint>

#include "host/model/config/config.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

struct PointDistance {
  double distance_m = 0.0;          // signed, see clearance.hpp
  Vec3 normal{};                    // gradient, unit
  std::array<Vec3, 3> curvature{};  // second derivatives [1/m]; those of the face, edge or corner that is nearest; 0
                                    // inside a box, and of convex bodies
};

// Obstacles are numbered as in clearance.hpp.
PointDistance point_distance(const Vec3& point, const config::SceneConfig& scene, std::int32_t obstacle);

}  // namespace liana::planner
