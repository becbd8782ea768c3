// The poses in which the load of an arm is measured, and the two sides from which it comes to each.
//
// Friction between cables and holes changes its sign with the side from which the arm comes to a pose. The mean of both
// readings is free from it to first order of mu times the bend; so each pose is come to from `approach_rad` before it
// and from as much behind, in a direction in which every cable slides through every segment.
//
// Poses are chosen one after the other, each the candidate that adds most to what is known: D-optimal design, Fedorov
// 1972, Theory of Optimal Experiments.
#pragma once

#include <vector>

#include "host/model/config/config.hpp"

namespace liana::calibration {

constexpr std::size_t kLoadPoses = 12;
constexpr std::size_t kMinLoadPoses = 4;
constexpr double kApproach_rad = 2.0 * 3.14159265358979323846 / 180.0;  // largest; a seventh of a segment's limit

struct LoadPose {
  cable::ThetaVector theta_rad{};
  cable::ThetaVector approach_rad{};

  // Where the arm is beside it: on the side of -1 or 1, and 0 at the pose.
  cable::ThetaVector beside_rad(double side) const;
};

// `count` poses within 0.8 of the limits of every angle whose planned tensions keep floor and ceiling, on both sides,
// too. Throws std::runtime_error when the arm has no load, or no such pose is found. Cost: about a second.
std::vector<LoadPose> load_poses(const cable::RobotParams& table, std::size_t count = kLoadPoses);

// The same for a pose of the user's. Throws std::runtime_error when it leaves no room to a limit on either side, or its
// planned tensions leave floor or ceiling.
LoadPose load_pose(const cable::RobotParams& table, const cable::ThetaVector& theta_rad);

}  // namespace liana::calibration
