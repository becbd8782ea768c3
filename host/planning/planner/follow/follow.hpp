// Follow-the-leader: the tip goes along a curve and the body stays on the path the tip took, as well as the arm can.
//
// An arm on a base that feeds takes its length from the slide. Every link end is as near as it can be to the track: the
// slide's axis, the arm's own line at the start, then the curve (follow_pose.hpp). A body that leaves the curve by more
// than kFollowBodyOff_m is refused.
//
// An arm with a fixed base cannot follow exactly. Ten angles bend 40 links, and the part that is not on the curve yet
// has to give the length that the tip goes forwards: its bends become flatter. So the tip is exact, and every link end
// is as near as it can be to the track: the arm's own line at the start, then the curve (follow_pose.hpp). How far off
// the body is, is measured (follow_statistics.hpp).
#pragma once

#include <string>

#include "host/planning/planner/follow/curve.hpp"
#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

constexpr double kFollowStep_m = 0.01;       // of the tip along the curve
constexpr double kFollowTipOff_m = 0.002;    // of the tip from the curve between waypoints
constexpr double kFollowBodyOff_m = 0.015;   // of the body of an arm that is fed from the curve behind the tip
constexpr double kFollowMostLengths = 2.0;   // of the arm: no body stays on a longer curve
constexpr double kFollowStartOff_m = 0.001;  // how far from the tip a curve may begin

// A way along a curve, or what stands against it.
struct FollowPath {
  // From the start pose to the end of the curve, empty when there is none. As few waypoints as keep the steps of the
  // request and, between them, the tip within kFollowTipOff_m of the curve; where neither can be kept, the independent
  // check and the figures tell.
  Path theta_rad;
  std::string constraint;  // curve, start, tip
  std::string reason;
};

// The given points as a curve; without points, through the scene's slit: from the tip, smoothly, to where the axis of
// the goal pose passes the mouth, and on along that axis. The request needs points or a scene with a slit whose inside
// the goal pose's tip is in.
struct FollowCurve {
  std::vector<Vec3> points_m;
  std::string reason;  // why there are no points
};
FollowCurve slit_curve(const Room& room, const ThetaVector& from_rad, const ThetaVector& goal_rad);

// The way along `curve`, to `goal_rad` where it is given (its tip at the curve's end). Nothing when cancelled.
FollowPath follow_path(const Room& room, const PlanRequest& request, const Curve& curve,
                       const std::optional<ThetaVector>& goal_rad, const PlanControl& control);

}  // namespace liana::planner
