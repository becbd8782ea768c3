// Distances between a link and an obstacle: a link is a capsule, an obstacle a sphere, an oriented box or a convex
// body. Whole arms are in arm_clearance.hpp and self_clearance.hpp, whole motions in along_motion.hpp. The planner and
// both verification ends ask here; who asks brings points of the arm's axis, from whatever kinematics it has.
//
// A slit is what its two plates leave free, so it is no shape of its own here: the plates are boxes of the scene.
// Distances are between surfaces and signed: negative means overlap, by the depth to the nearest face or surface. The
// distance of a point to a box or sphere is convex, so a link's nearest point to them is found in closed form: no
// iteration to a tolerance, no sampling. Nothing allocates. Derivatives: where a point p of the link moves by
// dp(share), the distance changes by normal . dp(share) wherever the nearest points are unique. They are not where a
// link lies parallel to a face, and where its axis passes through a box (any of the faces may be the way out).
#pragma once

#include <cstdint>
#include <span>

#include "firmware_like/math/pose.hpp"
#include "host/model/config/config.hpp"

namespace liana::clearance {

// The arm's axis in the base frame [m]: point 0 is its base, point i the end of link i - 1. Links are numbered from 0.
using AxisPoints = std::span<const Vec3>;

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

// Capsule to convex body by the search of Gilbert, Johnson and Keerthi (1988), at most kMaxSteps of it. The distance
// is that of the best pair of parallel planes found between the two, so it is never above the true one, and below it by
// less than 1e-7 m for bodies of the scene's sizes; where no planes are found the body counts as touched (distance 0 or
// below). Of a link whose axis is inside the body, the depth is that of the shortest way out found among fixed
// directions and their neighbours: never less than the true one. Cost: 3,000 to 20,000 instructions.
Clearance clearance(const Capsule& link, const config::SceneConvex& body) noexcept;
constexpr int kMaxSteps = 64;

// Obstacles are numbered: the scene's spheres first, then its boxes, then its convex bodies.
std::int32_t obstacle_count(const config::SceneConfig& scene) noexcept;
const std::string& obstacle_name(const config::SceneConfig& scene, std::int32_t obstacle) noexcept;
// The same for obstacle 0..obstacle_count - 1.
Clearance clearance(const Capsule& link, const config::SceneConfig& scene, std::int32_t obstacle) noexcept;

// Link 0..points - 2 as a capsule.
Capsule link_capsule(AxisPoints points, std::int32_t link, double radius_m) noexcept;

// Farther than anything is: the distance where there is nothing to be near to.
constexpr double kNoObstacle_m = 1e3;

}  // namespace liana::clearance
