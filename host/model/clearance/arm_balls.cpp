#include "host/model/clearance/arm_balls.hpp"

#include <algorithm>
#include <cmath>

namespace liana::clearance {
namespace {

using Index = std::size_t;

constexpr double kFarthest_m = 1e6, kFarthest2_m2 = 1e12;

// Around the points from the first to the last, centred between these two, which is the least ball of a straight row.
Ball ball_around(AxisPoints points) {
  Ball ball{scale(add(points.front(), points.back()), 0.5), 0.0};
  double radius2 = 0.0;
  for (const Vec3& point : points) {
    const Vec3 from_center = subtract(point, ball.center_m);
    const double here2 = dot(from_center, from_center);
    if (!(here2 < kFarthest2_m2)) return {point, kFarthest_m};
    radius2 = std::max(radius2, here2);
  }
  ball.radius_m = std::sqrt(radius2);
  return ball;
}

}  // namespace

ArmBalls::ArmBalls(AxisPoints points, double radius_m) noexcept
    : links_(std::max(static_cast<std::int32_t>(points.size()) - 1, 0)) {
  size_ = std::max(kGroup, (links_ + kMaxGroups - 1) / kMaxGroups);
  count_ = (links_ + size_ - 1) / size_;
  for (std::int32_t g = 0; g < count_; ++g) {
    const Index from = static_cast<Index>(first(g)), to = static_cast<Index>(first(g + 1));
    Ball& ball = ball_[static_cast<Index>(g)];
    ball = ball_around(points.subspan(from, to - from + 1));
    ball.radius_m += radius_m;
    sound_ = sound_ && norm(ball.center_m) + ball.radius_m < kFarthest_m;
  }
}

double min_possible_m(const Ball& ball, const config::SceneSphere& sphere) noexcept {
  return norm(subtract(ball.center_m, sphere.center_m)) - sphere.radius_m - ball.radius_m;
}

double min_possible_m(const Ball& ball, const config::SceneBox& box) noexcept {
  const Vec3 from_center = subtract(ball.center_m, box.center_m);
  double outside2 = 0.0, most = -kNoObstacle_m;
  for (Index i = 0; i < 3; ++i) {
    const double beyond = std::fabs(dot(box.rotation[i], from_center)) - box.half_extent_m[i];
    most = std::max(most, beyond);
    if (beyond > 0.0) outside2 += beyond * beyond;
  }
  return (most > 0.0 ? std::sqrt(outside2) : most) - ball.radius_m;
}

double min_possible_m(const Capsule& link, const config::SceneBox& box) noexcept {
  const Vec3 from = subtract(link.from_m, box.center_m), to = subtract(link.to_m, box.center_m);
  double most = -kNoObstacle_m;
  for (Index i = 0; i < 3; ++i) {
    const double a = dot(box.rotation[i], from), b = dot(box.rotation[i], to);
    most = std::max(most, std::max(std::min(a, b), -std::max(a, b)) - box.half_extent_m[i]);
  }
  return most - link.radius_m;
}

// Inside the box around a body nothing is known of the body.
double min_possible_m(const Ball& ball, const config::SceneConvex& body) noexcept {
  double outside2 = 0.0;
  for (Index i = 0; i < 3; ++i) {
    const double beyond = std::fabs(ball.center_m[i] - body.center_m[i]) - body.half_extent_m[i];
    if (beyond > 0.0) outside2 += beyond * beyond;
  }
  return outside2 > 0.0 ? std::sqrt(outside2) - ball.radius_m : -kNoObstacle_m;
}

double min_possible_m(const Capsule& link, const config::SceneConvex& body) noexcept {
  double most = 0.0;
  for (Index i = 0; i < 3; ++i) {
    const double a = link.from_m[i] - body.center_m[i], b = link.to_m[i] - body.center_m[i];
    most = std::max(most, std::max(std::min(a, b), -std::max(a, b)) - body.half_extent_m[i]);
  }
  return most > 0.0 ? most - link.radius_m : -kNoObstacle_m;
}

}  // namespace liana::clearance
