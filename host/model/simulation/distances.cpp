#include "host/model/simulation/distances.hpp"

#include <algorithm>
#include <cmath>

#include "host/model/clearance/arm_clearance.hpp"
#include "host/model/clearance/obstacles.hpp"

namespace liana::simulation {

namespace {

void add_body(config::SceneConfig& scene, const config::SceneSphere& body) { scene.spheres.push_back(body); }
void add_body(config::SceneConfig& scene, const config::SceneBox& body) { scene.boxes.push_back(body); }
void add_body(config::SceneConfig& scene, const config::SceneConvex& body) { scene.convex.push_back(body); }

config::SceneConfig with_only(const config::SceneConfig& scene, std::int32_t obstacle) {
  config::SceneConfig out;
  clearance::with_obstacle(scene, obstacle, [&](const auto& body) { add_body(out, body); });
  return out;
}

}  // namespace

void Way::begin(double length_m) {
  length_m_ = length_m;
  points_.clear();
  gone_m_.clear();
}

// On the way between two poses a point leaves the straight line by at most an eighth of what its path bends: the arm's
// length times the square of all turns.
void Way::add(clearance::AxisPoints axis_m, double turned_rad) {
  points_per_pose_ = axis_m.size();
  const std::size_t before = points_.size();
  points_.insert(points_.end(), axis_m.begin(), axis_m.end());
  if (gone_m_.empty()) {
    gone_m_.push_back(0.0);
    return;
  }
  double most2 = 0.0;
  for (std::size_t i = 0; i < points_per_pose_; ++i) {
    const Vec3 way = subtract(points_[before + i], points_[before - points_per_pose_ + i]);
    most2 = std::max(most2, dot(way, way));
  }
  gone_m_.push_back(gone_m_.back() + std::sqrt(most2) + 0.25 * length_m_ * turned_rad * turned_rad);
}

namespace {

struct OfScene {
  Nearest nearest;
  double at_start_m, at_end_m;
};

OfScene min_of(const config::SceneConfig& scene, const Pieces& pieces, const Pose& drawing_in_base, const Way& way,
               double enough_m, double step_s) {
  // Bodies stay as they are drawn, and the arm's axis goes to them.
  const Pose base_in_drawing = inverse(drawing_in_base);
  std::vector<Vec3> axis_m(pieces.points);
  const auto look = [&](std::size_t pose) {
    const auto in_base_m = way.axis(pose).subspan(pieces.first_point, pieces.points);
    std::transform(in_base_m.begin(), in_base_m.end(), axis_m.begin(), [&](const Vec3& point_m) {
      return add(rotate(base_in_drawing.quaternion, point_m), base_in_drawing.position_m);
    });
    return clearance::arm_clearance(axis_m, pieces.radius_m, scene);
  };
  const auto along = clearance::min_along({way.gone_m(), 1.0, enough_m, kUnseen_m},
                                          [&](std::int32_t pose) { return look(static_cast<std::size_t>(pose)); });
  const std::int32_t link = along.nearest.link;
  return {{along.at_least_m, link < 0 ? link : link + static_cast<std::int32_t>(pieces.first_point),
           along.nearest.obstacle, along.pose * step_s},
          look(0).distance_m(),
          look(way.size() - 1).distance_m()};
}

OfScene min_of_all(const OfScene& a, const OfScene& b) {
  return {b.nearest.distance_m < a.nearest.distance_m ? b.nearest : a.nearest, std::min(a.at_start_m, b.at_start_m),
          std::min(a.at_end_m, b.at_end_m)};
}

}  // namespace

// An arm that touches one body has one least distance to the scene, behind which all other bodies hide.
void measure_to_scene(std::span<const Pieces> arm, const StandingScene& standing, const Way& way, double enough_m,
                      double step_s, Distances& out) {
  const auto of = [&](const config::SceneConfig& scene) {
    OfScene least = min_of(scene, arm.front(), standing.drawing_in_base, way, enough_m, step_s);
    for (const Pieces& pieces : arm.subspan(1))
      least = min_of_all(least, min_of(scene, pieces, standing.drawing_in_base, way, enough_m, step_s));
    return least;
  };
  const OfScene all = of(standing.scene);
  out.scene = all.nearest;
  out.scene_at_start_m = all.at_start_m;
  out.scene_at_end_m = all.at_end_m;
  out.bodies.clear();
  if (all.at_start_m >= standing.scene.margins.prediction_m) return;
  for (std::int32_t body = 0; body < clearance::obstacle_count(standing.scene); ++body) {
    OfScene one = of(with_only(standing.scene, body));
    one.nearest.other = body;
    out.bodies.push_back({one.at_start_m, one.nearest});
  }
}

}  // namespace liana::simulation
