#include "host/model/clearance/self_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/model/clearance/arm_balls.hpp"

namespace liana::clearance {
namespace {

double clamped_share(double part, double whole) { return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0; }

class SelfSearch {
 public:
  SelfSearch(AxisPoints points, double radius_m, std::int32_t min_apart)
      : points_(points), radius_m_(radius_m), min_apart_(min_apart), balls_(points, radius_m) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      longest_m_ = std::max(longest_m_, norm(subtract(points[i + 1], points[i])));
  }

  bool sound() const { return balls_.sound(); }

  // The pair of balls that may be nearest comes first: what is found there leaves out most of the rest.
  SelfClearance least() {
    std::int32_t first = 0, second = 0;
    double least_m = kNoObstacle_m;
    each_pair([&](std::int32_t g, std::int32_t h) {
      if (gap_m(g, h) < least_m) least_m = gap_m(g, h), first = g, second = h;
    });
    look_at(first, second);
    each_pair([&](std::int32_t g, std::int32_t h) {
      if (gap_m(g, h) <= out_.nearest_m + kRounding_m) look_at(g, h);
    });
    return out_;
  }

 private:
  // All pairs of balls with links that count.
  template <class Use>
  void each_pair(Use&& use) const {
    for (std::int32_t g = 0; g < balls_.count(); ++g) {
      for (std::int32_t h = g; h < balls_.count(); ++h) {
        if (balls_.first(h + 1) - 1 - balls_.first(g) >= min_apart_) use(g, h);
      }
    }
  }

  void look_at(std::int32_t g, std::int32_t h) {
    for (std::int32_t link = balls_.first(g); link < balls_.first(g + 1); ++link) {
      const std::int32_t from = std::max(balls_.first(h), link + min_apart_);
      for (std::int32_t other = from; other < balls_.first(h + 1); ++other) {
        if (may_be_least(link, other)) measure(link, other);
      }
    }
  }

  // By the middles of both links, from which nothing of them is farther than half the longest.
  bool may_be_least(std::int32_t link, std::int32_t other) const {
    const Vec3 between = subtract(twice_middle(link), twice_middle(other));
    const double reach_m = 2.0 * (out_.nearest_m + 2.0 * radius_m_ + longest_m_ + kRounding_m);
    return dot(between, between) <= reach_m * reach_m;
  }

  Vec3 twice_middle(std::int32_t link) const {
    const std::size_t i = static_cast<std::size_t>(link);
    return add(points_[i], points_[i + 1]);
  }

  // Of equal pairs the first in order stays, in whatever order they are looked at.
  void measure(std::int32_t link, std::int32_t other) {
    const double here_m = between_m(link_capsule(points_, link, radius_m_), link_capsule(points_, other, radius_m_));
    const bool before = link < out_.link || (link == out_.link && other < out_.other);
    if (here_m < out_.nearest_m || (here_m == out_.nearest_m && before)) out_ = {here_m, link, other};
  }

  double gap_m(std::int32_t g, std::int32_t h) const {
    const Ball &a = balls_.ball(g), &b = balls_.ball(h);
    return norm(subtract(a.center_m, b.center_m)) - a.radius_m - b.radius_m;
  }

  AxisPoints points_;
  double radius_m_;
  std::int32_t min_apart_;
  ArmBalls balls_;
  double longest_m_ = 0.0;
  SelfClearance out_;
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

SelfClearance self_clearance(AxisPoints points, double radius_m, std::int32_t min_apart) noexcept {
  SelfSearch search(points, radius_m, min_apart);
  return search.sound() ? search.least() : SelfClearance{-kNoObstacle_m, 0, 0};
}

std::int32_t min_apart(double joint_limit_rad) noexcept {
  return static_cast<std::int32_t>(std::ceil(std::numbers::pi / (std::numbers::sqrt2 * joint_limit_rad)));
}

}  // namespace liana::clearance
