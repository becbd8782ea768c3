#include "host/planning/planner/follow/curve_points.hpp"

#include "host/planning/planner/plan.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::planner {
namespace {

constexpr config::Range kPlace{-100, 100};          // m
constexpr double kMinGap_m = 0.001 * (1.0 - 1e-9);  // between the points: 1 mm in decimals counts as 1 mm

}  // namespace

std::vector<Vec3> curve_points(const config::Field& list) {
  const std::size_t count =
      list.size(2, kMaxFollowPoints, "give the points of the curve in order, the tip's place first");
  std::vector<Vec3> points_m;
  for (std::size_t i = 0; i < count; ++i) {
    points_m.push_back(list.element(i).numbers<3>(kPlace));
    if (i == 0) continue;
    const double gap_m = norm(subtract(points_m[i], points_m[i - 1]));
    if (gap_m < kMinGap_m)
      list.element(i).refuse(text("points at least 1 mm apart; this is %.3f mm from the one before", 1000.0 * gap_m),
                             "leave one of them out");
  }
  return points_m;
}

}  // namespace liana::planner
