#include "host/planning/planner/follow/follow_track.hpp"

namespace liana::planner {
namespace {

Curve center_line(const Room& room, const ThetaVector& theta_rad) {
  const LinkPoints points = link_points(room.table(), theta_rad);
  return Curve({points.point_in_base.begin(), points.point_in_base.begin() + points.count});
}

}  // namespace

FollowTrack::FollowTrack(const Room& room, const ThetaVector& from_rad, const Curve& curve)
    : start_line_(center_line(room, from_rad)), curve_(curve) {}

CurvePlace FollowTrack::nearest(const Vec3& point_m, double from_m, double until_m) const {
  if (from_m >= 0.0) return curve_.nearest(point_m, from_m, until_m);
  CurvePlace before = start_line_.nearest(point_m, start_length_m() + from_m, start_length_m() + until_m);
  before.along_m -= start_length_m();
  if (until_m <= 0.0) return before;
  const CurvePlace after = curve_.nearest(point_m, 0.0, until_m);
  return norm(subtract(point_m, after.position_m)) < norm(subtract(point_m, before.position_m)) ? after : before;
}

}  // namespace liana::planner
