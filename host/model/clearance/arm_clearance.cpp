#include "host/model/clearance/arm_clearance.hpp"

#include <algorithm>

#include "host/model/clearance/arm_balls.hpp"
#include "host/model/clearance/obstacles.hpp"

namespace liana::clearance {
namespace {

using Index = std::size_t;

// Where to begin: the obstacle and the ball that may be nearest. What is found there leaves out most of the rest.
struct Guess {
  double least_m = kNoObstacle_m;
  std::int32_t obstacle = -1;
  std::int32_t group = 0;
};

class ArmSearch {
 public:
  ArmSearch(AxisPoints points, double radius_m, const config::SceneConfig& scene)
      : points_(points), radius_m_(radius_m), scene_(scene), balls_(points, radius_m) {}

  bool sound() const { return balls_.sound(); }

  ArmClearance least() const {
    ArmClearance out;
    out.nearest.distance_m = kNoObstacle_m;
    const double enough_m = bound_m() + kRounding_m;  // nothing beyond can be the least
    each_obstacle(scene_, [&](const auto& obstacle, std::int32_t number) {
      for (std::int32_t g = 0; g < balls_.count(); ++g) {
        if (min_possible_m(balls_.ball(g), obstacle) <= enough_m) look_at(obstacle, number, g, enough_m, out);
      }
    });
    return out;
  }

 private:
  template <class Obstacle>
  void look_at(const Obstacle& obstacle, std::int32_t number, std::int32_t group, double enough_m,
               ArmClearance& out) const {
    for (std::int32_t link = balls_.first(group); link < balls_.first(group + 1); ++link) {
      const Capsule capsule = link_capsule(points_, link, radius_m_);
      if (min_possible_m(capsule, obstacle) > enough_m) continue;
      const Clearance here = clearance(capsule, obstacle);
      if (here.distance_m < out.nearest.distance_m) out = {here, link, number};
    }
  }

  // The least distance of the links in the ball that may be nearest.
  double bound_m() const {
    Guess guess;
    each_obstacle(scene_, [&](const auto& obstacle, std::int32_t number) {
      for (std::int32_t g = 0; g < balls_.count(); ++g) {
        const double least_m = min_possible_m(balls_.ball(g), obstacle);
        if (least_m < guess.least_m) guess = {least_m, number, g};
      }
    });
    if (guess.obstacle < 0) return kNoObstacle_m;
    double bound_m = kNoObstacle_m;
    for (std::int32_t link = balls_.first(guess.group); link < balls_.first(guess.group + 1); ++link) {
      const Capsule capsule = link_capsule(points_, link, radius_m_);
      bound_m = std::min(bound_m, clearance(capsule, scene_, guess.obstacle).distance_m);
    }
    return bound_m;
  }

  AxisPoints points_;
  double radius_m_;
  const config::SceneConfig& scene_;
  ArmBalls balls_;
};

template <class Obstacle>
void measure_links(AxisPoints points, double radius_m, const Obstacle& obstacle, double within_m,
                   std::vector<Clearance>& out) {
  const ArmBalls balls(points, radius_m);
  for (std::int32_t g = 0; g < balls.count(); ++g) {
    const double ball_m = min_possible_m(balls.ball(g), obstacle) - kRounding_m;
    for (std::int32_t link = balls.first(g); link < balls.first(g + 1); ++link) {
      const Capsule capsule = link_capsule(points, link, radius_m);
      const double least_m = ball_m >= within_m ? ball_m : min_possible_m(capsule, obstacle) - kRounding_m;
      Clearance& here = out[static_cast<Index>(link)];
      if (least_m >= within_m) {
        here = {};
        here.distance_m = least_m;
      } else {
        here = clearance(capsule, obstacle);
      }
    }
  }
}

}  // namespace

ArmClearance arm_clearance(AxisPoints points, double radius_m, const config::SceneConfig& scene) noexcept {
  const ArmSearch search(points, radius_m, scene);
  if (search.sound()) return search.least();
  ArmClearance out;
  out.nearest.distance_m = -kNoObstacle_m;
  out.link = 0;
  out.obstacle = obstacle_count(scene) > 0 ? 0 : -1;
  return out;
}

void link_clearances(AxisPoints points, double radius_m, const config::SceneConfig& scene, std::int32_t obstacle,
                     double within_m, std::vector<Clearance>& out) {
  out.resize(points.size() - 1);
  with_obstacle(scene, obstacle, [&](const auto& body) { measure_links(points, radius_m, body, within_m, out); });
}

}  // namespace liana::clearance
