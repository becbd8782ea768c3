#include "host/planning/planner/start/retract.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/motion/servo_ik.hpp"
#include "host/planning/planner/start/relax.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr std::int32_t kSettleIterations = 6;
constexpr double kTipOffLine_m = 0.01;  // how far the tip may leave the arm's line

// Shortest turn that brings the x axis onto a direction.
Quat x_axis_along(const Vec3& direction) {
  const Vec3 unit = scale(direction, 1.0 / norm(direction));
  return normalize({1.0 + unit[0], 0.0, -unit[2], unit[1]});  // 1 + x.u, x cross u
}

// Pose of the arm's axis `behind_m` behind the tip.
Pose on_axis(const LinkPoints& points, double behind_m) {
  for (Index i = Index(points.count) - 1; i > 0; --i) {
    const Vec3 link = subtract(points.point_in_base[i], points.point_in_base[i - 1]);
    const double length_m = norm(link);
    if (behind_m > length_m && i > 1) {
      behind_m -= length_m;
      continue;
    }
    return {subtract(points.point_in_base[i], scale(link, behind_m / length_m)), x_axis_along(link)};
  }
  return {};
}

}  // namespace

Path retract(const Room& room, const ThetaVector& theta_rad, std::uint32_t held_mask, double margin_m) {
  const LinkPoints line = link_points(room.table(), theta_rad);
  const double length_m = arm_length_m(room.table());
  Path path{theta_rad};
  for (double behind_m = kRetractStep_m; behind_m < kRetractShare * length_m; behind_m += kRetractStep_m) {
    if (room.look(path.back()).nearest.distance_m > kOutside_m) break;
    const PoseAim aim{on_axis(line, behind_m), true, path.back(), held_mask, margin_m + kRelaxReach_m};
    const SettledPose next = settle(room, aim, path.back(), kSettleIterations);
    if (next.clearance_m < margin_m || next.tip_error_m > kTipOffLine_m ||
        !room.is_free(path.back(), next.theta_rad, margin_m))
      break;
    path.push_back(next.theta_rad);
  }
  return path;
}

}  // namespace liana::planner
