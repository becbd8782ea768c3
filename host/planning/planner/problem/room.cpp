#include "host/planning/planner/problem/room.hpp"

#include <algorithm>
#include <cmath>

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kMinAdvance_m = 0.004;  // near the margin poses are looked at this often

}  // namespace

clearance::ArmClearance Room::look(const ThetaVector& theta_rad) const {
  return clearance::arm_clearance(link_points(robot_.table, theta_rad).axis(), robot_.module_radius_m, scene_);
}

double Room::motion_m(const ThetaVector& a, const ThetaVector& b) const {
  double lever_m = 0.0, motion = 0.0;
  for (Index m = static_cast<Index>(robot_.table.segment_count); m-- > 0;) {
    const SegmentParams& segment = robot_.table.segment[m];
    if (feeds(segment)) motion += segment.slide_m_rad * std::fabs(b[0] - a[0]) + lever_m * std::fabs(b[1] - a[1]);
    lever_m += segment.modules * segment.module_length_m;
    motion += segment.modules * lever_m * std::hypot(b[2 * m] - a[2 * m], b[2 * m + 1] - a[2 * m + 1]);
  }
  return motion;
}

bool Room::is_free(const ThetaVector& a, const ThetaVector& b, double margin_m) const {
  const double motion = motion_m(a, b);
  // A pose with clearance c is safe for c - margin of motion.
  for (double gone = 0.0;;) {
    const double spare = look(between(a, b, motion > 0.0 ? gone / motion : 0.0)).nearest.distance_m - margin_m;
    if (spare < 0.0) return false;
    if (gone >= motion) return true;
    gone = std::min(motion, gone + std::max(spare, kMinAdvance_m));
  }
}

double arm_length_m(const RobotParams& table) {
  double length_m = 0.0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m)
    length_m += table.segment[m].modules * table.segment[m].module_length_m;
  return length_m;
}

double least_bend_radius_m(const RobotParams& table) {
  double least_m = 1e300;
  for (Index m = static_cast<Index>(table.first_bending()); m < static_cast<Index>(table.segment_count); ++m) {
    const SegmentParams& segment = table.segment[m];
    least_m = std::min(least_m, 0.5 * segment.module_length_m / std::tan(0.5 * segment.theta_limit_rad));
  }
  return least_m;
}

ThetaVector between(const ThetaVector& a, const ThetaVector& b, double share) {
  ThetaVector theta{};
  for (Index k = 0; k < theta.size(); ++k) theta[k] = (1.0 - share) * a[k] + share * b[k];
  return theta;
}

double largest_change(const ThetaVector& a, const ThetaVector& b) {
  double most = 0.0;
  for (Index k = 0; k < a.size(); ++k) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

}  // namespace liana::planner
