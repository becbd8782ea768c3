// A tree of links as the files of other tools.
#pragma once

#include <string>
#include <vector>

#include "host/model/description/robot_tree.hpp"

namespace liana::description {

// URDF 1.0. Joints that follow another one have `mimic`; a hull of the scene is the box around it. Crosses between two
// axes weigh 1 mg, since simulators refuse links without mass. `scene`: shapes of a link "scene", in the base frame;
// none: no such link.
std::string urdf(const RobotTree& tree, const std::vector<Shape>& scene);

// MJCF, which MuJoCo 2.2.2 and newer load. A joint that follows another one is coupled by an equality; a cable is a
// spatial tendon whose actuator pulls like a rope of the commanded length; a key for every named pose, the start pose
// first.
std::string mjcf(const RobotTree& tree, const std::vector<Shape>& scene);

}  // namespace liana::description
