#include "host/control/clearance_bound/verified_clearance.hpp"

#include <algorithm>
#include <cmath>

namespace liana::clearance_bound {
namespace {

constexpr double kStep_rad = 1e-6;       // of the differences that stand for the derivatives of joint centres
constexpr double kLargestBound_m = 0.1;  // a pair that is this much farther apart than the least claim is not it

Vec3 between(const Vec3& from, const Vec3& to, double share) { return add(scale(from, 1.0 - share), scale(to, share)); }

}  // namespace

ClearanceFinder::ClearanceFinder(const RobotParams& table, double radius_m, const config::SceneConfig& scene,
                                 const BoundRule& rule)
    : table_(table), layout_(cable_layout(table)), radius_m_(radius_m), scene_(scene), rule_(rule) {}

// Where joint centres are, and how they move with each cable's length error and with time.
void ClearanceFinder::move(const MeasuredArm& arm, const KnownScene& known) {
  const AnglesOfLengths angles = angles_of_lengths(table_, layout_, arm.theta_rad);
  const ThetaVector& theta_rad = believed_rad_ =
      changed(angles, arm.theta_rad, known.registration.length_error_m(), table_.cable_count());
  motion_.points = link_points(table_, theta_rad);
  const std::size_t points = static_cast<std::size_t>(motion_.points.count),
                    cables = static_cast<std::size_t>(table_.cable_count());
  for (std::size_t p = 0; p < points; ++p) {
    std::fill_n(motion_.by_length[p].begin(), cables, Vec3{});
    motion_.velocity_m_s[p] = {};
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(table_.theta_count()); ++i) {
    ThetaVector moved_rad = theta_rad;
    moved_rad[i] += kStep_rad;
    const LinkPoints moved = link_points(table_, moved_rad);
    for (std::size_t p = 0; p < points; ++p) {
      const Vec3 change_m = subtract(moved.point_in_base[p], motion_.points.point_in_base[p]);
      const Vec3 slope = scale(change_m, 1.0 / kStep_rad);
      motion_.velocity_m_s[p] = add(motion_.velocity_m_s[p], scale(slope, arm.rate_rad_s[i]));
      for (std::size_t c = 0; c < cables; ++c)
        motion_.by_length[p][c] = add(motion_.by_length[p][c], scale(slope, angles[c][i]));
    }
  }
  motion_.in_drawing = motion_.points;
  for (std::size_t p = 0; known.has_seen && p < points; ++p)
    motion_.in_drawing.point_in_base[p] = known.registration.drawn(motion_.points.point_in_base[p]);
}

// One link and one body, found in the frame of the drawing.
VerifiedClearance ClearanceFinder::judged(const clearance::Clearance& found, std::int32_t link, std::int32_t obstacle,
                                          const KnownScene& known) const {
  const Registration& registration = known.registration;
  const std::size_t from = static_cast<std::size_t>(link);
  const Vec3 where_m = known.has_seen ? registration.registered(found.on_axis_m) : found.on_axis_m;
  const Vec3 outward = known.has_seen ? rotate(quaternion_of(registration.turn_rad()), found.normal) : found.normal;
  const Vec3 from_origin = subtract(where_m, registration.pivot_m());
  const double body = known.has_seen ? -1.0 : 0.0;  // a body that is where it is drawn has its allowance instead
  CableVector by_length{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(table_.cable_count()); ++c)
    by_length[c] = dot(outward, between(motion_.by_length[from][c], motion_.by_length[from + 1][c], found.share));
  const double variance_m2 =
      registration.variance(scale(outward, body), scale(cross(from_origin, outward), body), by_length);
  const Vec3 velocity_m_s = between(motion_.velocity_m_s[from], motion_.velocity_m_s[from + 1], found.share);
  const double uncertain_m = rule_.constant_m + rule_.sigmas * std::sqrt(variance_m2);
  const double allowance_m = known.has_seen ? 0.0 : known.shift_m + known.turn_rad * norm(from_origin);
  const double bound_m = uncertain_m + allowance_m + rule_.ahead_s * std::max(0.0, -dot(outward, velocity_m_s));
  return {found.distance_m - bound_m, bound_m, link, obstacle, where_m, uncertain_m, allowance_m};
}

VerifiedClearance ClearanceFinder::find(const MeasuredArm& arm, const KnownScene& known) {
  move(arm, known);
  VerifiedClearance least;
  std::array<VerifiedClearance, kPoints> of_link;
  for (std::int32_t obstacle = 0; obstacle < clearance::obstacle_count(scene_); ++obstacle) {
    for (std::int32_t link = 0; link + 1 < motion_.in_drawing.count; ++link) {
      const clearance::Capsule capsule = clearance::link_capsule(motion_.in_drawing.axis(), link, radius_m_);
      const clearance::Clearance found = clearance::clearance(capsule, scene_, obstacle);
      if (found.distance_m - kLargestBound_m >= least.distance_m) continue;
      const VerifiedClearance here = judged(found, link, obstacle, known);
      if (here.distance_m < least.distance_m) least = here;
      VerifiedClearance& min_of_link = of_link[static_cast<std::size_t>(link)];
      if (here.distance_m < min_of_link.distance_m) min_of_link = here;
    }
  }
  near_links_ = {};
  for (const VerifiedClearance& link : of_link) {
    if (link.distance_m > least.distance_m + kSoon_m) continue;
    near_links_.uncertain_m = std::max(near_links_.uncertain_m, link.uncertain_m);
    near_links_.allowance_m = std::max(near_links_.allowance_m, link.allowance_m);
  }
  return least;
}

}  // namespace liana::clearance_bound
