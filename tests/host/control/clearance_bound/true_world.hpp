// A world that nobody told the room under test: an arm whose cables are longer than measured, a scene that stands
// beside its drawing, and a camera with noise. All of it by seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "host/control/clearance_bound/live_clearance.hpp"
#include "host/model/clearance/arm_clearance.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::clearance_bound {

inline const config::SceneConfig& panel_slit() {
  static const config::SceneConfig kScene =
      config::parse_scene(config::good_table("scene", "panel_slit").dump(), "panel_slit");
  return kScene;
}

inline config::RobotConfig zhu2022_config() {
  config::RobotConfig robot;
  robot.table = zhu2022::table();
  robot.module_radius_m = 0.03;
  return robot;
}

// Angles in the slit, the tip 0.5 m from the rod's, and at the rod.
constexpr zhu2022::Degrees kInSlit_deg{-2.79, -3.1, -1.85, -5.0, 4.9, 7.2, 0.4, 5.9, 0.0, -1.2};

class TrueWorld {
 public:
  struct Size {
    double length_m = 0.0;  // of every cable's error, standard deviation
    double shift_m = 0.0;   // of the scene, exactly
    double turn_deg = 0.0;
    double noise_m = 0.0003, noise_deg = 0.05;
  };

  TrueWorld(std::uint64_t seed, const Size& size) : generator_(seed), size_(size), scene_(panel_slit()) {
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) length_m_[c] = normal(size.length_m);
    shift_m_ = scale(direction(), size.shift_m);
    turn_ = quaternion_of(scale(direction(), size.turn_deg * kDegree));
    for (config::SceneBox& box : scene_.boxes) {
      box.center_m = moved(box.center_m);
      for (Vec3& axis : box.rotation) axis = rotate(turn_, axis);
    }
    for (config::SceneSphere& sphere : scene_.spheres) sphere.center_m = moved(sphere.center_m);
  }

  // Where the arm truly is when `measured_rad` is what its lengths say.
  ThetaVector true_rad(const ThetaVector& measured_rad) const {
    return changed(angles_of_lengths(table_, layout_, measured_rad), measured_rad, length_m_, table_.cable_count());
  }
  double true_clearance_m(const ThetaVector& measured_rad) const {
    return clearance::arm_clearance(link_points(table_, true_rad(measured_rad)).axis(), 0.03, scene_)
        .nearest.distance_m;
  }
  Pose slit() const { return moved(pose(panel_slit().slit->frame)); }
  Pose rod() const { return moved(pose(panel_slit().rod->pose)); }
  // What the camera sees, with noise.
  Picture picture(std::uint64_t tick, const ThetaVector& measured_rad) {
    const Pose tip = tip_pose(table_, arm_trig(table_, true_rad(measured_rad)));
    return {tick, seen(compose(inverse(tip), slit())), seen(compose(inverse(tip), rod()))};
  }

 private:
  double normal(double sigma) { return sigma * std::normal_distribution<double>(0.0, 1.0)(generator_); }
  Vec3 direction() {
    const Vec3 raw{normal(1.0), normal(1.0), normal(1.0)};
    return scale(raw, 1.0 / norm(raw));
  }
  static Pose pose(const config::ScenePose& pose) { return {pose.position_m, pose.quaternion_wxyz}; }
  Vec3 moved(const Vec3& drawn_m) const {
    const Vec3& pivot_m = panel_slit().slit->frame.position_m;
    return add(add(pivot_m, shift_m_), rotate(turn_, subtract(drawn_m, pivot_m)));
  }
  Pose moved(const Pose& drawn) const {
    return {moved(drawn.position_m), normalize(multiply(turn_, drawn.quaternion))};
  }
  Pose seen(const Pose& exact) {
    const Vec3 off_m{normal(size_.noise_m), normal(size_.noise_m), normal(size_.noise_m)};
    const double noise_rad = size_.noise_deg * kDegree;
    const Vec3 off_rad{normal(noise_rad), normal(noise_rad), normal(noise_rad)};
    return {add(exact.position_m, off_m), normalize(multiply(exact.quaternion, quaternion_of(off_rad)))};
  }

  std::mt19937_64 generator_;
  Size size_;
  RobotParams table_ = zhu2022::table();
  CableLayout layout_ = cable_layout(table_);
  config::SceneConfig scene_;
  CableVector length_m_{};
  Vec3 shift_m_{};
  Quat turn_{};
};

// From one pose to another in `intervals` command intervals, with a picture every second one, 120 ms late; `judge`
// looks at every claim. `spoil` may change a picture or swallow it.
template <class Judge, class Spoil>
void travel(LiveClearance& live, TrueWorld& world, const ThetaVector& from_rad, const ThetaVector& to_rad,
            int intervals, std::uint64_t& tick, const Judge& judge, const Spoil& spoil) {
  std::vector<Picture> waiting;
  for (int k = 0; k < intervals; ++k, tick += 5) {
    ThetaVector now_rad = from_rad;
    const double share = 0.5 - 0.5 * std::cos(3.14159265358979 * (k + 1) / intervals);
    for (std::size_t i = 0; i < now_rad.size(); ++i) now_rad[i] += share * (to_rad[i] - from_rad[i]);
    judge(live.look(tick, now_rad), now_rad);
    if (k % 2 == 0) {
      std::optional<Picture> picture = world.picture(tick, now_rad);
      spoil(picture);
      if (picture) waiting.push_back(*picture);
    }
    if (waiting.empty() || waiting.front().tick + 30 > tick) continue;
    live.see(waiting.front(), tick);
    waiting.erase(waiting.begin());
  }
}

inline void nothing_spoiled(std::optional<Picture>&) {}

}  // namespace liana::clearance_bound
