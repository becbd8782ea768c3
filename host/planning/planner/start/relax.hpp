// Start paths pulled tight and pushed off obstacles: Gauss-Newton on the planner's smoothness plus a penalty for
// clearance below what is wanted. This is what makes Ipopt converge (docs/explanation/path-planning.md): it starts
// beside the solution, on a path that is free.
#pragma once

#include <cstdint>
#include <vector>

#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

constexpr std::int32_t kRelaxIterations = 40;
constexpr double kRelaxReach_m = 0.010;  // clearance beyond the margin that the penalty asks for

// Relaxes the free thetas of all waypoints but the ends; limits hold. Each iteration solves one block-tridiagonal
// system.
Path relax(const Room& room, const PlanRequest& request, Path path);

// Least clearance over a path looked at every `spacing_m` of motion, and where.
struct PathLook {
  double distance_m = clearance::kNoObstacle_m;
  std::int32_t interval = 0;
  double share = 0.0;
  std::int32_t link = -1;
  std::int32_t obstacle = -1;
};
PathLook look_along(const Room& room, const Path& path, double spacing_m);

// `count` waypoints along a path: its corners first, those that turn most, then the middles of the longest pieces.
Path resample(const Room& room, const Path& path, std::int32_t count);

// Pose poses: a tip to be reached while the arm keeps clear and stays near where it was.
struct PoseAim {
  Pose tip_in_base{};
  bool direction_only = false;  // the tip may roll about its x axis
  ThetaVector near_rad{};       // weakly drawn here
  std::uint32_t held_mask = 0;
  double clearance_m = 0.0;  // wanted
};
struct SettledPose {
  ThetaVector theta_rad{};
  double tip_error_m = 0.0;
  double clearance_m = 0.0;
};
// Gauss-Newton from `theta_rad`, `iterations` steps.
SettledPose settle(const Room& room, const PoseAim& aim, ThetaVector theta_rad, std::int32_t iterations);

}  // namespace liana::planner
