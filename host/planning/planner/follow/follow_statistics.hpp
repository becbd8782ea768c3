// How well a body followed its tip: measured on the finished plan, with the chain of the independent check.
#pragma once

#include <cstdint>
#include <vector>

#include "host/model/config/config.hpp"
#include "host/planning/planner/follow/curve.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

// Looked at the waypoints and three times between. Every link end is asked for its distance from the path before it:
// the arm's centre line at the start, and from its tip on the way that the tip has gone so far.
struct FollowStatistics {
  double curve_length_m = 0.0;
  double tip_off_m = 0.0;          // greatest distance of the tip from the curve
  double body_off_m = 0.0;         // greatest distance of a link end from that path
  double mean_body_off_m = 0.0;    // over all link ends and poses
  std::int32_t worst_link = 0;     // from 1: the link whose end is farthest off
  double worst_tip_along_m = 0.0;  // where on the curve the tip was then

  // Of any point of the arm's axis from the curve behind the tip; before the curve's beginning from the arm's line at
  // the start, and behind a base that feeds from the slide's axis.
  double curve_off_m = 0.0;
  std::int32_t curve_off_segment = 0;  // from 1: where on the arm that is
  double curve_off_along_m = 0.0;      // the place on the curve that is nearest, below 0 before its beginning
  double curve_off_tip_along_m = 0.0;  // and that of the tip then
};

// Figures of waypoints [rad] against a curve. Cost: about 0.1 s for 200 waypoints.
FollowStatistics follow_figures(const RobotParams& table, const std::vector<ThetaVector>& waypoints_rad,
                                const Curve& curve);

}  // namespace liana::planner
