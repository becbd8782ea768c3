// Distances of a whole arm: from a scene, and from itself.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "host/model/clearance/arm_clearance.hpp"
#include "host/model/clearance/self_clearance.hpp"
#include "tests/benchmarks/meter.hpp"
#include "tests/benchmarks/problems.hpp"
#include "tests/firmware_like/panel_slit.hpp"

namespace liana::bench {

using namespace cable;
namespace {

constexpr double kRadius_m = 0.03;

// The scene panel_slit: the plates of its slit, and its ball.
config::SceneConfig plates_and_ball() {
  const inverse_kinematics::SlitMouth slit = panel_slit();
  const auto axis = [&](const Vec3& v) { return rotate(slit.frame_in_base.quaternion, v); };
  config::SceneConfig scene;
  for (const double side : {1.0, -1.0}) {
    const Vec3 from_mouth = axis({0.5 * slit.depth_m, side * 0.06, 0.0});
    scene.boxes.push_back({"plate",
                           add(slit.frame_in_base.position_m, from_mouth),
                           {0.5 * slit.depth_m, 0.01, 2.0},
                           {axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1})}});
  }
  scene.spheres.push_back({"ball", {-0.15, 0.28, 1.10}, 0.25});
  return scene;
}

// Poses in the slit and anywhere.
std::vector<ThetaVector> poses(const RobotParams& robot) {
  std::vector<ThetaVector> out = random_poses(robot, kCalls / 2);
  zhu2022::Random random(5);
  while (out.size() < kCalls) {
    ThetaVector theta = zhu2022::radians(zhu2022::kPressRod_deg);
    const ThetaVector beside = random.theta(robot, 0.3);
    for (std::size_t k = 0; k < theta.size(); ++k) theta[k] += beside[k];
    out.push_back(theta);
  }
  return out;
}

void measure(Meter& meter) {
  const RobotParams robot = zhu2022::table();
  const config::SceneConfig scene = plates_and_ball();
  std::vector<LinkPoints> points;
  for (const ThetaVector& theta : poses(robot)) points.push_back(link_points(robot, theta));
  const std::int32_t apart = clearance::min_apart(robot.segment[0].theta_limit_rad);
  meter.each("arm_clearance", "ours", kCalls,
             [&](std::size_t i) { return clearance::arm_clearance(points[i].axis(), kRadius_m, scene).distance_m(); });
  meter.each("arm_clearance", "every_pair", kCalls, [&](std::size_t i) {
    double least_m = clearance::kNoObstacle_m;
    for (std::int32_t link = 0; link + 1 < points[i].count; ++link) {
      const clearance::Capsule capsule = clearance::link_capsule(points[i].axis(), link, kRadius_m);
      for (std::int32_t obstacle = 0; obstacle < clearance::obstacle_count(scene); ++obstacle)
        least_m = std::min(least_m, clearance::clearance(capsule, scene, obstacle).distance_m);
    }
    return least_m;
  });
  meter.each("self_clearance", "every_pair", kCalls, [&](std::size_t i) {
    double least_m = clearance::kNoObstacle_m;
    for (std::int32_t a = 0; a + 1 < points[i].count; ++a) {
      const clearance::Capsule link = clearance::link_capsule(points[i].axis(), a, kRadius_m);
      for (std::int32_t b = a + apart; b + 1 < points[i].count; ++b)
        least_m = std::min(least_m, between_m(link, clearance::link_capsule(points[i].axis(), b, kRadius_m)));
    }
    return least_m;
  });
  meter.each("self_clearance", "ours", kCalls,
             [&](std::size_t i) { return clearance::self_clearance(points[i].axis(), kRadius_m, apart).distance_m(); });
}

}  // namespace
}  // namespace liana::bench

int main() try {
  liana::bench::Meter meter;
  liana::bench::measure(meter);
  meter.print();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
