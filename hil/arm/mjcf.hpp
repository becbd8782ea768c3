// The arm and its scene as MuJoCo XML, made in memory.
#pragma once

#include <string>
#include <vector>

#include "hil/config/robot_config.hpp"
#include "hil/config/scene_config.hpp"

namespace liana::bench {

// With a base first its carriage, a body without shape that slides along x and turns about it. Then hinges in the order
// of the links, two per link; one body per module with inertia of a solid cylinder. Arm geoms touch
// the scene and never each other; the last link does not touch the rod. The scene's shapes are world geoms, the rod is
// named "rod". `with_tendons` adds one spatial tendon per cable through sites at the holes (the independent check of
// the cable lengths; slow). As files for a MujocoModel: a long arm is in several.
std::vector<std::string> make_mjcf(const RobotConfig& robot, const SceneConfig& scene, bool with_tendons);

}  // namespace liana::bench
