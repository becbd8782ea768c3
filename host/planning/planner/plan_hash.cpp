
#include "host/base/json/json.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/sha256.hpp"
#include "host/planning/planner/plan.hpp"

namespace liana::planner {
namespace {

Json angles(const ThetaVector& theta_rad, std::int32_t count) {
  return std::vector<double>(theta_rad.begin(), theta_rad.begin() + count);
}

Json inputs(const PlanRequest& request) {
  const std::int32_t count = request.robot.table.theta_count();
  Json held = Json::array(), points = Json::array();
  for (const HeldPhase& phase : request.held) held.push_back({phase.theta, phase.value_rad, phase.from_share});
  for (const ControlPoint& point : request.control_points)
    points.push_back({point.node, point.position_m, point.weight});
  Json out{{"from_rad", angles(request.from_rad, count)},
           {"held", held},
           {"control_points", points},
           {"waypoints", request.waypoints},
           {"margin_m", request.margin_m},
           {"max_step_rad", request.max_step_rad}};
  if (request.to_rad) out["to_rad"] = angles(*request.to_rad, count);
  if (request.follow) out["follow"] = request.follow->points_m;
  if (request.tip_in_base) out["tip"] = {request.tip_in_base->position_m, request.tip_in_base->quaternion};
  return out;
}

}  // namespace

std::string plan_hash(const PlanRequest& request, const PlanResult& result) {
  Json waypoints = Json::array();
  for (const ThetaVector& theta : result.waypoints_rad)
    waypoints.push_back(angles(theta, request.robot.table.theta_count()));
  const Json outcome{{"outcome", name_of(result.outcome)}, {"waypoints_rad", waypoints}};
  return config::sha256_hex(request.robot.canonical_json + "\n" + request.scene.canonical_json + "\n" +
                            config::canonical_json(inputs(request)) + "\n" + config::canonical_json(outcome) + "\n");
}

}  // namespace liana::planner
