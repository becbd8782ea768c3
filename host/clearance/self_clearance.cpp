#include "host/clearance/self_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/clearance/arm_balls.hpp"

namespace liana::clearance {
namespace {

double clamped_share(double part, double whole) { return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0; }

class SelfSearch {
 public:
  SelfSearch(AxisPoints points, double radius_m, std::int32_t least_apart)
      : points_(points), radius_m_(radius_m), least_apart_(least_apart), balls_(points, radius_m) {}

  bool sound() const { return balls_.sound(); }

  // In order of links, so that of equal pairs the first stays.
  SelfClearance least() const {
    SelfClearance out;
    for (std::int32_t g = 0; g < balls_.count(); ++g) {
      for (std::int32_t link = balls_.first(g); link < balls_.first(g + 1); ++link) look_from(g, link, out);
    }
    return out;
  }

 private:
  void look_from(std::int32_t group, std::int32_t link, SelfClearance& out) const {
    const Capsule capsule = link_capsule(points_, link, radius_m_);
    const Ball ball = ball_of(capsule);
    for (std::int32_t h = group; h < balls_.count(); ++h) {
      const std::int32_t from = std::max(balls_.first(h), link + least_apart_), to = balls_.first(h + 1);
      if (from >= to || gap_m(ball, balls_.ball(h)) > out.nearest_m + kRounding_m) continue;
      for (std::int32_t other = from; other < to; ++other) {
        const double here_m = between_m(capsule, link_capsule(points_, other, radius_m_));
        if (here_m < out.nearest_m) out = {here_m, link, other};
      }
    }
  }

  static Ball ball_of(const Capsule& link) {
    const Vec3 half = scale(subtract(link.to_m, link.from_m), 0.5);
    return {add(link.from_m, half), norm(half) + link.radius_m};
  }

  static double gap_m(const Ball& a, const Ball& b) {
    return norm(subtract(a.center_m, b.center_m)) - a.radius_m - b.radius_m;
  }

  AxisPoints points_;
  double radius_m_;
  std::int32_t least_apart_;
  ArmBalls balls_;
};

}  // namespace

// The nearest points of the whole lines, moved onto the axes one after the other, which is exact because the squared
// distance is convex in both shares and each is bounded by itself.
double between_m(const Capsule& a, const Capsule& b) noexcept {
  const Vec3 u = subtract(a.to_m, a.from_m), v = subtract(b.to_m, b.from_m), w = subtract(a.from_m, b.from_m);
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  double s = clamped_share(uv * vw - vv * uw, uu * vv - uv * uv);
  const double t = clamped_share(vw + s * uv, vv);
  s = clamped_share(t * uv - uw, uu);
  const Vec3 between = subtract(add(w, scale(u, s)), scale(v, t));
  return norm(between) - a.radius_m - b.radius_m;
}

SelfClearance self_clearance(AxisPoints points, double radius_m, std::int32_t least_apart) noexcept {
  const SelfSearch search(points, radius_m, least_apart);
  return search.sound() ? search.least() : SelfClearance{-kNoObstacle_m, 0, 0};
}

std::int32_t least_apart(double joint_limit_rad) noexcept {
  return static_cast<std::int32_t>(std::ceil(std::numbers::pi / (std::numbers::sqrt2 * joint_limit_rad)));
}

}  // namespace liana::clearance
