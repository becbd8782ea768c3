// Convex bodies of a scene: what they are made of, and where they end in a direction.
#pragma once

#include "host/model/config/config.hpp"

namespace liana::config {

// The hull of points (1..kMaxHullPoints, base frame, metres).
SceneConvex hull_of(std::string name, std::vector<Vec3> points_m);
// A cylinder with flat ends around two points, which must differ.
SceneConvex cylinder(std::string name, const Vec3& from_m, const Vec3& to_m, double radius_m);
// All points within a radius of the straight line between two points, which may coincide.
SceneConvex capsule(std::string name, const Vec3& from_m, const Vec3& to_m, double radius_m);

// The point of the body, less its ball, that is farthest in a direction (of any length but 0); of several the first.
// Cost: about 6 instructions a point.
Vec3 farthest_point(const SceneConvex& body, const Vec3& direction);

// How thick points are: the largest distance of one of them from the plane of three others that lie far apart; 0 for
// three and fewer.
double thickness_m(const std::vector<Vec3>& points_m);

}  // namespace liana::config
