#include "host/apps/cli/curve_file.hpp"

#include "host/planning/planner/follow/curve_points.hpp"

namespace liana::cli {

std::vector<Vec3> parse_curve(const std::string& text, const std::string& name) {
  const Json json = config::parse_json(text, name, "write {\"points_m\": [[x, y, z], ...]}, metres in the base frame");
  const config::Field curve(json, name, "");
  curve.only({"points_m"});
  return planner::curve_points(curve.at("points_m"));
}

}  // namespace liana::cli
