// What a following arm keeps to: its own centre line at the start, and from its tip on the curve. Behind a base that
// feeds the slide's axis goes on.
#pragma once

#include "host/planning/planner/follow/curve.hpp"
#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

// Where a base that feeds can go back to from a pose: the rear end of its slide, or nothing.
std::vector<Vec3> feed_line(const RobotParams& table, const ThetaVector& theta_rad);

class FollowTrack {
 public:
  // `from_rad` is the start pose, with its tip where the curve begins.
  FollowTrack(const Room& room, const ThetaVector& from_rad, const Curve& curve);

  const Curve& curve() const { return curve_; }
  double start_length_m() const { return start_line_.length_m(); }
  // The place nearest to a point, of those from `from_m` to `until_m`. Both are counted along the curve, and below 0
  // back from its beginning along the start line. Cost: one pass over that part, a piece per 5 mm.
  CurvePlace nearest(const Vec3& point_m, double from_m, double until_m) const;

 private:
  Curve start_line_;  // from the base, or from the rear end of its slide
  Curve curve_;
};

}  // namespace liana::planner
