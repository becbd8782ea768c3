// Exact distances of the arm's capsules to the scene.
#pragma once

#include <vector>

#include "hil/arm/chain.hpp"
#include "hil/config/scene_config.hpp"

namespace liana::bench {

// Smallest distance between the segment from `a` to `b` and a solid box; 0 when they meet. Exact, closed form.
double segment_box_distance_m(const Vec3& a, const Vec3& b, const BoxConfig& box);
// Smallest distance between the segment from `a` to `b` and a point.
double segment_point_distance_m(const Vec3& a, const Vec3& b, const Vec3& point);

constexpr double kFarAway_m = 1000.0;

// Surface to surface; negative means overlap (to boxes down to minus the capsule radius).
struct Clearance {
  double slit_m = 0.0;    // any link to any box
  double sphere_m = 0.0;  // any link to any sphere
  double convex_m = 0.0;  // any link to any convex body
  double rod_m = 0.0;     // any link but the last to the rod
};

// Over the capsules between these points, one after the other, none the same as the one before; a kind with no shapes
// gives 1000 m.
Clearance clearance_of(const std::vector<Vec3>& axis_m, const SceneConfig& scene, double radius_m);
// Over all links.
Clearance clearance_of(const Chain& chain, const SceneConfig& scene, double link_radius_m);

}  // namespace liana::bench
