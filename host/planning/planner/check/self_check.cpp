#include "host/planning/planner/check/self_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/planning/planner/check/path_search.hpp"
#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/check/vectors.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::planner {
namespace {

using Vector = std::array<double, 3>;
using Index = std::size_t;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector along(const Vector& from, const Vector& way, double share) {
  return {from[0] + share * way[0], from[1] + share * way[1], from[2] + share * way[2]};
}
double length(const Vector& v) { return std::sqrt(product(v, v)); }

double clamped_share(double part, double whole) { return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0; }

// Least distance of two line pieces: the nearest points of the whole lines, moved onto the pieces one after the other,
// which is exact because the squared distance is convex in both shares and each is bounded by itself.
double pieces_distance_m(const Vector& a, const Vector& a_end, const Vector& b, const Vector& b_end) {
  const Vector u = minus(a_end, a), v = minus(b_end, b), w = minus(a, b);
  const double uu = product(u, u), vv = product(v, v), uv = product(u, v), uw = product(u, w), vw = product(v, w);
  double s = clamped_share(uv * vw - vv * uw, uu * vv - uv * uv);
  const double t = clamped_share(vw + s * uv, vv);
  s = clamped_share(t * uv - uw, uu);
  return length(minus(along(a, u, s), along(b, v, t)));
}

// Joints between two links that can bend by half a turn at their limits: with fewer the links cannot touch.
Index min_gap(const RobotParams& table) {
  double limit_rad = 0.0;
  for (Index m = 0; m < Index(table.segment_count); ++m) {
    if (!feeds(table.segment[m])) limit_rad = std::max(limit_rad, table.segment[m].theta_limit_rad);
  }
  return static_cast<Index>(std::ceil(std::numbers::pi / (std::numbers::sqrt2 * limit_rad)));
}

}  // namespace

SelfClearance self_clearance(const config::RobotConfig& robot, const ThetaVector& theta_rad) {
  const std::vector<Vector> end = plain_axis(robot.table, theta_rad);
  const Index gap = min_gap(robot.table);
  SelfClearance least;
  least.link = {0, 0};
  for (Index a = 1; a + gap < end.size(); ++a) {
    for (Index b = a + gap; b < end.size(); ++b) {
      const double between_m = pieces_distance_m(end[a - 1], end[a], end[b - 1], end[b]) - 2.0 * robot.module_radius_m;
      if (between_m < least.clearance_m)
        least = {between_m, {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)}};
    }
  }
  return least;
}

std::string nearest_text(const SelfClearance& self) {
  return text("link %d ", static_cast<int>(self.link[1])) +
         distance_text(self.clearance_m, text("link %d of the arm itself", static_cast<int>(self.link[0])));
}

SelfClearance self_clearance_along(const config::RobotConfig& robot, const std::vector<ThetaVector>& path) {
  SelfClearance least;
  least.link = {0, 0};
  const auto look = [&](const ThetaVector& theta_rad) {
    const SelfClearance here = self_clearance(robot, theta_rad);
    if (here.clearance_m < least.clearance_m) least = here;
    return here.clearance_m;
  };
  PathSearch(robot.table, look, 2.0, kSelfNear_m).along(path);  // both links move
  return least;
}

}  // namespace liana::planner
