#include "host/planning/planner/follow/follow_track.hpp"

namespace liana::planner {
namespace {

constexpr double kLeastFeed_rad = 1e-3;  // in front of its rear end a slide stands at it

Curve center_line(const Room& room, const ThetaVector& theta_rad) {
  const LinkPoints points = link_points(room.table(), theta_rad);
  std::vector<Vec3> line = feed_line(room.table(), theta_rad);
  line.insert(line.end(), points.point_in_base.begin(), points.point_in_base.begin() + points.count);
  return Curve(line);
}

}  // namespace

std::vector<Vec3> feed_line(const RobotParams& table, const ThetaVector& theta_rad) {
  if (table.feed_count() == 0) return {};
  const SegmentParams& base = table.segment[0];
  if (theta_rad[0] + base.theta_limit_rad < kLeastFeed_rad) return {};
  return {{-base.slide_m_rad * base.theta_limit_rad, 0.0, 0.0}};
}

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
