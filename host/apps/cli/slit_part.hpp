// What `liana pose --scene` adds: which part of the arm has to be planar in the scene's slit, and what its yaws may be.
#pragma once

#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"

namespace liana::cli {

// The scene has to have a slit. `planar_segments`, `held_theta`, `root` (x,y,z,qw,qx,qy,qz of the planar part, base
// frame; null without one) and `yaw_range_deg` (per segment of it: [lowest, highest], or null where it fits nowhere);
// see host/model/inverse_kinematics/dof_split.hpp.
Json slit_part(const config::RobotConfig& robot, const config::SceneConfig& scene, const cable::ThetaVector& theta_rad);

}  // namespace liana::cli
