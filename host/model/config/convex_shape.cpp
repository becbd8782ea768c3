#include "host/model/config/convex_shape.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/pose.hpp"

namespace liana::config {
namespace {

// The box along the base axes, from where the body ends along them.
SceneConvex with_box(SceneConvex body) {
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 axis{};
    axis[i] = 1.0;
    const double high_m = farthest_point(body, axis)[i] + body.round_m;
    axis[i] = -1.0;
    const double low_m = farthest_point(body, axis)[i] - body.round_m;
    body.center_m[i] = 0.5 * (low_m + high_m);
    body.half_extent_m[i] = 0.5 * (high_m - low_m);
  }
  return body;
}

Vec3 unit(const Vec3& v) { return scale(v, 1.0 / norm(v)); }

// The point for which `size` is largest.
template <class Size>
Vec3 largest(const std::vector<Vec3>& points_m, const Size& size) {
  return *std::max_element(points_m.begin(), points_m.end(),
                           [&](const Vec3& a, const Vec3& b) { return size(a) < size(b); });
}

}  // namespace

SceneConvex hull_of(std::string name, std::vector<Vec3> points_m) {
  SceneConvex body;
  body.name = std::move(name);
  body.points_m = std::move(points_m);
  return with_box(std::move(body));
}

SceneConvex cylinder(std::string name, const Vec3& from_m, const Vec3& to_m, double radius_m) {
  SceneConvex body;
  body.name = std::move(name);
  body.points_m = {from_m, to_m};
  const Vec3 axis = subtract(to_m, from_m);
  const std::size_t least = std::fabs(axis[0]) < std::fabs(axis[1]) ? 0 : 1;
  Vec3 beside{};
  beside[std::fabs(axis[2]) < std::fabs(axis[least]) ? 2 : least] = 1.0;
  body.disc_axes[0] = unit(cross(axis, beside));
  body.disc_axes[1] = unit(cross(axis, body.disc_axes[0]));
  body.disc_radius_m = radius_m;
  return with_box(std::move(body));
}

SceneConvex capsule(std::string name, const Vec3& from_m, const Vec3& to_m, double radius_m) {
  SceneConvex body;
  body.name = std::move(name);
  body.points_m = {from_m, to_m};
  body.round_m = radius_m;
  return with_box(std::move(body));
}

Vec3 farthest_point(const SceneConvex& body, const Vec3& direction) {
  const Vec3* farthest = &body.points_m.front();
  double most = dot(*farthest, direction);
  for (const Vec3& point : body.points_m) {
    const double here = dot(point, direction);
    if (here > most) most = here, farthest = &point;
  }
  if (body.disc_radius_m == 0.0) return *farthest;
  const auto& [u, v] = body.disc_axes;
  const double along_u = dot(direction, u), along_v = dot(direction, v),
               length = std::sqrt(along_u * along_u + along_v * along_v);
  if (length == 0.0) return *farthest;
  const double share_m = body.disc_radius_m / length;
  return add(*farthest, add(scale(u, along_u * share_m), scale(v, along_v * share_m)));
}

double thickness_m(const std::vector<Vec3>& points_m) {
  const Vec3 first = points_m.front();
  const Vec3 second = largest(points_m, [&](const Vec3& p) { return norm(subtract(p, first)); });
  const Vec3 line = subtract(second, first);
  const Vec3 third = largest(points_m, [&](const Vec3& p) { return norm(cross(line, subtract(p, first))); });
  const Vec3 across = cross(line, subtract(third, first));
  const double area = norm(across);
  if (!(area > 0.0)) return 0.0;
  const auto off = [&](const Vec3& p) { return std::fabs(dot(across, subtract(p, first))) / area; };
  return off(largest(points_m, off));
}

}  // namespace liana::config
