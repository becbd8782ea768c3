// The lines that the links of a serial arm lie about, where MuJoCo has put them, and how far their capsules are from
// the scene. The bench has no force between them: an arm that goes into a body is not stopped, but truth tells.
#pragma once

#include <vector>

#include "hil/arm/mujoco_model.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/config/serial_config.hpp"

namespace liana::bench {

// From the end of the first link's way along its joint's axis, which never moves, to the tip: for each link along z by
// d, then along x by a; what has no length is left out.
std::vector<Vec3> link_axis_m(const MujocoModel& arm, const SerialRobotConfig& robot);

bool has_bodies(const SceneConfig& scene);

// Least distance of the capsules of `radius_m` about this line to any body; negative: in it.
double clearance_m(const std::vector<Vec3>& axis_m, const SceneConfig& scene, double radius_m);

}  // namespace liana::bench
