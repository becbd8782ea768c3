#include "host/model/clearance/clearance.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/pose.hpp"
#include "host/model/clearance/obstacles.hpp"

namespace liana::clearance {
namespace {

using Index = std::size_t;

}  // namespace

Clearance clearance(const Capsule& link, const config::SceneSphere& sphere) noexcept {
  const Vec3 axis = subtract(link.to_m, link.from_m);
  const double length2 = dot(axis, axis);
  Clearance out;
  if (length2 > 0.0) out.share = std::clamp(dot(subtract(sphere.center_m, link.from_m), axis) / length2, 0.0, 1.0);
  out.on_axis_m = add(link.from_m, scale(axis, out.share));
  const Vec3 away = subtract(out.on_axis_m, sphere.center_m);
  const double distance_m = norm(away);
  out.normal =
      distance_m > 0.0 ? scale(away, 1.0 / distance_m) : Vec3{0.0, 0.0, 1.0};  // at the centre every way out is as long
  out.on_obstacle_m = add(sphere.center_m, scale(out.normal, sphere.radius_m));
  out.distance_m = distance_m - sphere.radius_m - link.radius_m;
  return out;
}

std::int32_t obstacle_count(const config::SceneConfig& scene) noexcept {
  return static_cast<std::int32_t>(scene.spheres.size() + scene.boxes.size() + scene.convex.size());
}

const std::string& obstacle_name(const config::SceneConfig& scene, std::int32_t obstacle) noexcept {
  return with_obstacle(scene, obstacle, [](const auto& body) -> const std::string& { return body.name; });
}

Clearance clearance(const Capsule& link, const config::SceneConfig& scene, std::int32_t obstacle) noexcept {
  return with_obstacle(scene, obstacle, [&](const auto& body) { return clearance(link, body); });
}

Capsule link_capsule(AxisPoints points, std::int32_t link, double radius_m) noexcept {
  const Index i = static_cast<Index>(link);
  return {points[i], points[i + 1], radius_m};
}

}  // namespace liana::clearance
