// The robot, scene and buses all bench tests use; written by make_fixtures.py.
#pragma once

#include "hil/config/robot_config.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/math/random.hpp"
#include "hil/math/reduced.hpp"

namespace liana::bench {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
constexpr double kStep_s = 0.001;
constexpr double kSlot_s = 0.004;

inline RobotConfig fixture_robot() { return load_robot(HIL_DATA "/robot.json"); }
inline SceneConfig fixture_scene() { return load_scene(HIL_DATA "/scene.json"); }
// With its panel moved so far towards the arm.
inline SceneConfig squeezed_scene(double by_m) {
  SceneConfig scene = fixture_scene();
  scene.boxes[0].center_m = scene.boxes[0].center_m - by_m * scene.boxes[0].axis[1];
  return scene;
}
inline BusesConfig fixture_buses() { return load_buses(HIL_DATA "/buses.json"); }

inline Theta random_theta(Random& random, double limit_deg) {
  Theta theta{};
  for (std::size_t i = 0; i < 10; ++i) theta[i] = kRadPerDeg * random.uniform(-limit_deg, limit_deg);
  return theta;
}

}  // namespace liana::bench
