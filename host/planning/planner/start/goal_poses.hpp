// Joint angles to start from at the end of a plan whose goal is a tip pose.
#pragma once

#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

constexpr std::int32_t kGoalPoseSeeds = 8;
constexpr std::int32_t kGoalPoses = 3;

struct GoalPoses {
  Path theta_rad;             // at most kGoalPoses with at least the margin, the one nearest to the start first
  bool reachable = false;     // goal IK converged at least once
  ThetaVector nearest_rad{};  // of the poses that reach the tip: the one with most clearance
};

// Goal IK (host/model/inverse_kinematics/goal_ik.hpp) from the start pose and fixed seeds, each pushed off obstacles
// with its tip in place; also with the last one and two segments planar (their pitch, or their yaw, at 0), which is how
// an arm fits a slit that the tip is in line with. Where none of them is free, once more with clearance of the nearest
// spheres as an aim of the shape (GoalIkProblem::clear): that finds a pose where pushing gets stuck, but far from the
// start, and knows no boxes. Held thetas are those of the last waypoint.
GoalPoses goal_poses(const Room& room, const PlanRequest& request);

// Seed 0 is `from_rad`, 1 the straight arm, then patterns of signs at half the limits.
ThetaVector seed_pose(const RobotParams& table, const ThetaVector& from_rad, std::int32_t seed);

}  // namespace liana::planner
