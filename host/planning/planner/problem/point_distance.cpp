#include "host/planning/planner/problem/point_distance.hpp"

#include <cmath>

#include "firmware_like/math/pose.hpp"
#include "host/model/clearance/clearance.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;
using Matrix3 = std::array<Vec3, 3>;

void add_outer(const Vec3& v, double factor, Matrix3& out) {
  for (Index i = 0; i < 3; ++i) out[i] = add(out[i], scale(v, factor * v[i]));
}

// Around the point, the distance grows like that of a ball around the nearest feature: across `free` directions by 1 /
// distance.
Matrix3 curvature(const Matrix3& free, const Vec3& normal, double distance_m) {
  Matrix3 out{};
  for (const Vec3& axis : free) add_outer(axis, 1.0 / distance_m, out);
  add_outer(normal, -1.0 / distance_m, out);
  return out;
}

}  // namespace

PointDistance point_distance(const Vec3& point, const config::SceneConfig& scene, std::int32_t obstacle) {
  const clearance::Clearance found = clearance::clearance({point, point, 0.0}, scene, obstacle);
  PointDistance out{found.distance_m, found.normal, {}};
  const Index i = static_cast<Index>(obstacle);
  if (i < scene.spheres.size()) {
    const double from_center_m = found.distance_m + scene.spheres[i].radius_m;
    if (from_center_m > 0.0)
      out.curvature = curvature({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, out.normal, from_center_m);
    return out;
  }
  if (!(found.distance_m > 0.0)) return out;
  if (i >= scene.spheres.size() + scene.boxes.size()) return out;
  const config::SceneBox& box = scene.boxes[i - scene.spheres.size()];
  Matrix3 across{};  // axes along which the point is beyond the box
  for (Index k = 0; k < 3; ++k) {
    if (std::fabs(dot(box.rotation[k], subtract(point, box.center_m))) > box.half_extent_m[k])
      across[k] = box.rotation[k];
  }
  out.curvature = curvature(across, out.normal, found.distance_m);
  return out;
}

}  // namespace liana::planner
