// One pose of an arm that follows its tip along a curve.
#pragma once

#include <cstdint>

#include "host/planning/planner/follow/follow_track.hpp"
#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

struct FollowAim {
  double along_m = 0.0;         // where on the curve the tip is
  ThetaVector drawn_to_rad{};   // what the curve leaves free goes here,
  double draw = 0.0;            // this strongly: m^2/rad^2
  std::uint32_t held_mask = 0;  // bit i: theta i does not move
  double clearance_m = 0.0;     // wanted
  double body = 1.0;            // weight of the body's distance from the track
  double start_line = 1.0;      // share of it that counts before the curve's beginning
  double direction_m2 = 0.0;    // weight of the tip's direction against the curve's
  double far_m = 0.0;           // a link end so far off counts twice, and more farther off; 0: none does
};

// Joint angles near `theta_rad` with the tip on the curve and every link end as near to the track as it can be (least
// squares; those that are not past the curve's beginning yet count less), pushed off obstacles; limits hold exactly.
// Gauss-Newton, at most `iterations` steps, then some that bring the tip alone onto its place.
ThetaVector follow_pose(const Room& room, const FollowTrack& track, const FollowAim& aim, ThetaVector theta_rad,
                        std::int32_t iterations);

// Weighted sum of the squared distances of the link ends from the track, as follow_pose makes it least.
double misfit_m2(const Room& room, const FollowTrack& track, const FollowAim& aim, const ThetaVector& theta_rad);

// Distance of the tip from its place.
double tip_off_m(const Room& room, const Curve& curve, double along_m, const ThetaVector& theta_rad);

}  // namespace liana::planner
