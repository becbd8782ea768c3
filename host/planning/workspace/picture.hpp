// Pictures a person can read: a reachable region in three views, and a path's conditioning and limits.
#pragma once

#include <string>

#include "host/model/config/config.hpp"
#include "host/planning/workspace/path.hpp"
#include "host/planning/workspace/region.hpp"

namespace liana::workspace {

// The arm that is drawn over its region.
struct ArmDrawn {
  std::string name;         // of the robot
  double radius_m = 0.0;    // of its links; 0: as thin lines
  AngleVector angle_rad{};  // where it is drawn
};

// Top (x, y), side (x, z) and front (y, z) view of the region at one scale, in the base frame. The colour of a cell is
// the mean mobility of the samples in it, over the whole depth of the view; the arm and the scene (may be null) are
// drawn to scale over it.
std::string region_picture(const ReachArm& arm, const ArmDrawn& drawn, const config::SceneConfig* scene,
                           const RegionRequest& request, const Region& region);

// Least singular value, condition number and limit margins over the way of a cable arm, the worst places marked.
std::string path_picture(const config::RobotConfig& robot, const PathStatus& report, std::uint32_t held_mask);

// The holes of a disc, and every cable from the root to the disc that it ends at; cables are numbered as their drives,
// from 1.
std::string routing_picture(const config::RobotConfig& robot);

// "theta 7 = 0.5, theta 9 = 0 deg", or "none".
std::string held_text(const ReachArm& arm, std::uint32_t held_mask, const AngleVector& held_rad);

}  // namespace liana::workspace
