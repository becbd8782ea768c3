// The slit crossing's scene for tests: slit frame and rod in the base frame (mission scene panel_slit).
#pragma once

#include <cmath>

#include "host/model/config/config.hpp"
#include "host/operator/simulated/slit_view.hpp"

namespace liana::test {

// Unit quaternion of the rotation with these columns.
inline Quat quaternion_of_columns(const Vec3& x, const Vec3& y, const Vec3& z) {
  const double w = std::sqrt(1.0 + x[0] + y[1] + z[2]) / 2.0;
  return normalize({w, (y[2] - z[1]) / (4.0 * w), (z[0] - x[2]) / (4.0 * w), (x[1] - y[0]) / (4.0 * w)});
}

constexpr Vec3 kAcrossSlit{0.0036296, 0.9925349, -0.1219070};
constexpr Vec3 kIntoSlit{0.9999934, -0.0036025, 0.0004425};

inline Pose in_slit_plane(double into_m, double across_m) {
  const Vec3 place = add(scale(kIntoSlit, into_m), scale(kAcrossSlit, across_m - 0.7845031));
  return {place, quaternion_of_columns(kIntoSlit, kAcrossSlit, cross(kIntoSlit, kAcrossSlit))};
}

inline Pose press_rod() {
  return {{3.392167, -0.767048, 0.291155}, normalize({0.96559342, -0.05861635, 0.25277813, -0.01722436})};
}

inline simulated::SlitModel panel_slit() { return simulated::slit_drawing(in_slit_plane(1.75, 0.0), press_rod()); }

// The whole scene: the slit's two plates, the rod, and a sphere in the way (that of the scene where not said).
inline config::SceneConfig panel_scene(const config::SceneSphere& sphere = {"obstacle", {-0.15, 0.28, 1.10}, 0.25}) {
  config::SceneConfig scene;
  scene.spheres = {sphere};
  const Vec3 along = cross(kIntoSlit, kAcrossSlit);
  for (const double side : {1.0, -1.0}) {
    scene.boxes.push_back({side > 0.0 ? "panel" : "wall",
                           in_slit_plane(2.725, 0.06 * side).position_m,
                           {0.975, 0.01, 2.0},
                           {kIntoSlit, kAcrossSlit, along}});
  }
  const Pose mouth = in_slit_plane(1.75, 0.0), rod = press_rod();
  scene.slit.emplace();
  scene.slit->frame = {mouth.position_m, mouth.quaternion};
  scene.rod.emplace();
  scene.rod->pose = {rod.position_m, rod.quaternion};
  return scene;
}

}  // namespace liana::test
