#include "host/apps/cli/curve_file.hpp"

#include "host/model/config/field.hpp"
#include "host/planning/planner/plan.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::cli {
namespace {

constexpr config::Range kPlace{-100, 100};  // m

std::vector<Vec3> points_of(const config::Field& curve) {
  curve.only({"points_m"});
  const config::Field rows = curve.at("points_m");
  const std::size_t count =
      rows.size(2, planner::kMaxFollowPoints, "give the points of the curve in order, the tip's place first");
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(rows.element(i).numbers<3>(kPlace));
    if (i == 0) continue;
    const double gap_m = norm(subtract(points[i], points[i - 1]));
    if (gap_m < planner::kMinGap_m)
      rows.element(i).refuse(
          planner::text("points at least 1 mm apart; this is %.3f mm from the one before", 1000.0 * gap_m),
          "leave one of them out");
  }
  return points;
}

}  // namespace

std::vector<Vec3> parse_curve(const std::string& text, const std::string& name) {
  const Json json = config::parse_json(text, name, "write {\"points_m\": [[x, y, z], ...]}, metres in the base frame");
  return points_of(config::Field(json, name, ""));
}

}  // namespace liana::cli
