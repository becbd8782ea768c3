// The arm among the obstacles: clearance of a pose and of a straight piece in theta. What start paths are made with.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "host/model/clearance/arm_clearance.hpp"
#include "host/planning/planner/plan.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

class Room {
 public:
  // Both must outlive the room.
  Room(const config::RobotConfig& robot, const config::SceneConfig& scene) : robot_(robot), scene_(scene) {}

  const RobotParams& table() const { return robot_.table; }
  const config::SceneConfig& scene() const { return scene_; }
  double link_radius_m() const { return robot_.module_radius_m; }

  // Least clearance of one pose.
  clearance::ArmClearance look(const ThetaVector& theta_rad) const;

  // Bound on how far any point of the arm moves when the thetas change from a to b [m].
  double motion_m(const ThetaVector& a, const ThetaVector& b) const;

  // True when the arm keeps `margin_m` all the way from a to b, but for dips of less than 2 mm between the poses looked
  // at.
  bool is_free(const ThetaVector& a, const ThetaVector& b, double margin_m) const;

 private:
  const config::RobotConfig& robot_;
  const config::SceneConfig& scene_;
};

// From the base to the tip of the straight arm [m].
double arm_length_m(const RobotParams& table);

// Of the narrowest circle on which a segment can lie: both of its ends and its joints [m].
double least_bend_radius_m(const RobotParams& table);

// Pose at `share` (0..1) between a and b.
ThetaVector between(const ThetaVector& a, const ThetaVector& b, double share);

// Of any theta between a and b [rad].
double largest_change(const ThetaVector& a, const ThetaVector& b);

}  // namespace liana::planner
