// How well conditioned a cable arm is along a path of joint angles, and how near its limits.
//
// Between two waypoints all angles move in proportion; points lie so close that no angle changes by more than
// kPathStep_rad.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_like/cable/arm/kinematics.hpp"

namespace liana::workspace {

constexpr double kPathStep_rad = 0.25 * 3.14159265358979323846 / 180.0;  // resolution of a path
constexpr std::size_t kMaxWaypoints = 2000;

// One pose on the path. Singular values are of the 6 x free Jacobian of the tip with linear rows in m/rad and angular
// rows in rad/rad, that is attitude weighed by a length of 1 m; all 0 beyond the number of free thetas.
struct PathPoint {
  double way = 0.0;  // 0..1: share of the joint travel (largest change of any angle, summed) up to here
  cable::ThetaVector theta_rad{};
  Vec3 tip_in_base_m{};
  double least_singular_value = 0.0;
  double largest_singular_value = 0.0;
  double limit_margin_rad = 0.0;   // of the free theta that is nearest to its limit
  std::int32_t nearest_theta = 0;  // which one, from 1; the first of equals
};

struct PathStatus {
  std::vector<PathPoint> points;     // first and last are the ends of the path
  std::vector<double> waypoint_way;  // where the waypoints lie
  double joint_travel_rad = 0.0;
  std::size_t worst_conditioned = 0;  // index of the least singular value; the first of equals
  std::size_t nearest_limit = 0;      // index of the least margin; the first of equals
};

// Largest singular value over the least; infinite when the least is below 1e-12 times it.
double condition_number(const PathPoint& point);

// Examines a path of 1..kMaxWaypoints waypoints; thetas in `held_mask` are not free (at least one must be). Cost: about
// 10 us a point.
PathStatus examine_path(const cable::RobotParams& table, const std::vector<cable::ThetaVector>& waypoints_rad,
                        std::uint32_t held_mask);

}  // namespace liana::workspace
