// Distances between links and the scene, in closed form: a link is a capsule, an obstacle a sphere or an oriented box.
//
// A slit is what its two plates leave free, so it is no shape of its own here: the plates are boxes of the scene.
// Distances are between surfaces and signed: negative means overlap, by the depth to the nearest face or surface. The
// distance of a point to a box or sphere is convex, so a link's nearest point is found exactly: no iteration to a
// tolerance, no sampling. Nothing allocates. Derivatives: where a point p of the link moves by dp(share), the distance
// changes by normal . dp(share) wherever the nearest points are unique. They are not where a link lies parallel to a
// face, and where its axis passes through a box (any of the faces may be the way out).
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "host/config/config.hpp"

namespace liana::clearance {

using namespace cable;  // this room serves the cable arm only

// A link: all points within radius_m (>= 0) of the straight axis between two points of the base frame; they may
// coincide.
struct Capsule {
  Vec3 from_m{};
  Vec3 to_m{};
  double radius_m = 0.0;
};

// Signed distance and where it is taken.
struct Clearance {
  double distance_m = 0.0;  // between the surfaces; negative: depth of overlap
  double share =
      0.0;  // nearest point of the axis: from_m + share (to_m - from_m), 0..1; the first one where several are nearest
  Vec3 on_axis_m{};      // that point, base frame
  Vec3 on_obstacle_m{};  // nearest point of the obstacle's surface, base frame
  Vec3 normal{};         // unit, from the obstacle to the link: the way out
};

// Capsule to sphere: about 40 flops and two square roots.
Clearance clearance(const Capsule& link, const config::SceneSphere& sphere) noexcept;

// Capsule to oriented box, exact also at edges and corners: the axis is split where it passes the planes of the faces
// (at most 6 places), between which the squared distance is quadratic. Inside the box it is the depth to the nearest
// face, minimised over the axis.
Clearance clearance(const Capsule& link, const config::SceneBox& box) noexcept;

// Obstacles are numbered: the scene's spheres first, then its boxes.
std::int32_t obstacle_count(const config::SceneConfig& scene) noexcept;
const std::string& obstacle_name(const config::SceneConfig& scene, std::int32_t obstacle) noexcept;
// The same for obstacle 0..obstacle_count - 1.
Clearance clearance(const Capsule& link, const config::SceneConfig& scene, std::int32_t obstacle) noexcept;

// Link 0..links - 1 (link i ends at point i + 1) as a capsule.
Capsule link_capsule(const LinkPoints& points, std::int32_t link, double radius_m) noexcept;

// The least clearance of a whole arm, with the link and obstacle where it is.
struct ArmClearance {
  Clearance nearest;
  std::int32_t link = -1;      // 0-based; -1: the scene is empty, the distance then kNoObstacle_m
  std::int32_t obstacle = -1;  // see obstacle_name
};
constexpr double kNoObstacle_m = 1e3;

// Every link against every obstacle; on equal distances the first obstacle, then the first link, wins. 40 links and 3
// obstacles: about 5 us.
ArmClearance arm_clearance(const LinkPoints& points, double radius_m, const config::SceneConfig& scene) noexcept;

}  // namespace liana::clearance
