#include "hil/arm/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hil/arm/convex_distance.hpp"

namespace liana::bench {

namespace {

// Squared distance from a + t d to the box [-h, h], and its slope in t. Convex and piecewise quadratic in t.
struct Squared {
  double value;
  double slope;
};

Squared squared_distance(const std::array<double, 3>& a, const std::array<double, 3>& d, const std::array<double, 3>& h,
                         double t) {
  Squared result{0.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = a[k] + t * d[k];
    const double outside = x > h[k] ? x - h[k] : (x < -h[k] ? x + h[k] : 0.0);
    result.value += outside * outside;
    result.slope += 2.0 * outside * d[k];
  }
  return result;
}

}  // namespace

double segment_box_distance_m(const Vec3& a, const Vec3& b, const BoxConfig& box) {
  std::array<double, 3> start;
  std::array<double, 3> along;
  std::array<double, 8> breaks;  // where the piece of the function changes
  std::size_t count = 0;
  breaks[count++] = 0.0;
  breaks[count++] = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    start[k] = dot(box.axis[k], a - box.center_m);
    along[k] = dot(box.axis[k], b - a);
    if (along[k] == 0.0) continue;
    for (const double face : {-box.half_extent_m[k], box.half_extent_m[k]}) {
      const double t = (face - start[k]) / along[k];
      if (t > 0.0 && t < 1.0) breaks[count++] = t;
    }
  }
  for (std::size_t i = 1; i < count; ++i)  // insertion sort: at most eight
    for (std::size_t k = i; k > 0 && breaks[k] < breaks[k - 1]; --k) std::swap(breaks[k], breaks[k - 1]);
  Squared left = squared_distance(start, along, box.half_extent_m, 0.0);
  if (left.slope >= 0.0) return std::sqrt(left.value);
  for (std::size_t i = 1; i < count; ++i) {
    const Squared right = squared_distance(start, along, box.half_extent_m, breaks[i]);
    if (right.slope >= 0.0) {
      // The slope is linear inside a piece, so its zero is exact.
      const double t = breaks[i - 1] + (breaks[i] - breaks[i - 1]) * left.slope / (left.slope - right.slope);
      return std::sqrt(squared_distance(start, along, box.half_extent_m, t).value);
    }
    left = right;
  }
  return std::sqrt(left.value);
}

double segment_point_distance_m(const Vec3& a, const Vec3& b, const Vec3& point) {
  const Vec3 d = b - a;
  const double t = std::clamp(dot(point - a, d) / dot(d, d), 0.0, 1.0);
  return norm(point - (a + t * d));
}

Clearance clearance_of(const std::vector<Vec3>& axis_m, const SceneConfig& scene, double radius_m) {
  Clearance least{kFarAway_m, kFarAway_m, kFarAway_m, kFarAway_m};
  for (std::size_t i = 1; i < axis_m.size(); ++i) {
    const Vec3 &a = axis_m[i - 1], &b = axis_m[i];
    for (const auto& box : scene.boxes)
      least.slit_m = std::min(least.slit_m, segment_box_distance_m(a, b, box) - radius_m);
    for (const auto& sphere : scene.spheres)
      least.sphere_m =
          std::min(least.sphere_m, segment_point_distance_m(a, b, sphere.center_m) - sphere.radius_m - radius_m);
    for (const auto& body : scene.convex)
      least.convex_m = std::min(least.convex_m, segment_convex_distance_m(a, b, body) - radius_m);
    if (i + 1 < axis_m.size())
      least.rod_m = std::min(least.rod_m,
                             segment_point_distance_m(a, b, scene.rod.pose.position_m) - scene.rod.radius_m - radius_m);
  }
  return least;
}

Clearance clearance_of(const Chain& chain, const SceneConfig& scene, double link_radius_m) {
  std::vector<Vec3> axis;
  for (std::size_t i = 0; i <= chain.link_count(); ++i) axis.push_back(chain.joint_center_m(i));
  return clearance_of(axis, scene, link_radius_m);
}

}  // namespace liana::bench
