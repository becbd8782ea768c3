#include "host/apps/mission_runner/follow_plan.hpp"

#include <stdexcept>

#include "firmware_like/math/trig.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"
#include "host/planning/planner/follow/curve_points.hpp"
#include "host/planning/planner/plan.hpp"

namespace liana::mission_runner {
namespace {

constexpr const char* kCommand = "follow_curve";

cable::ThetaVector from_rad(const config::Field& list, const cable::RobotParams& table) {
  const auto count = static_cast<std::size_t>(table.theta_count());
  list.size(count, count, "give an angle for every theta of the robot");
  cable::ThetaVector theta_rad{};
  for (std::size_t k = 0; k < count; ++k) theta_rad[k] = kDegree * list.element(k).number({-180, 180});
  return theta_rad;
}

planner::PlanRequest plan_request(const Json& welcome, const Json& request) {
  const config::Field fields(request, kCommand, "");
  fields.only({"from_deg", "points", "margin_m"});
  planner::PlanRequest out;
  out.robot = config::parse_robot(welcome.at("robot").dump(), "robot", "nominal",
                                  config::parse_buses(welcome.at("buses").dump(), "buses"));
  out.scene = config::parse_scene(welcome.at("scene").dump(), "scene");
  out.from_rad = from_rad(fields.at("from_deg"), out.robot.table);
  out.follow.emplace().points_m = planner::curve_points(fields.at("points"));
  out.margin_m = fields.at("margin_m").number({0, 0.5});
  out.max_step_rad = planner::kFollowMaxStep_rad;
  return out;
}

}  // namespace

Json follow_plan(const Json& welcome, const Json& request) {
  const planner::PlanRequest asked = plan_request(welcome, request);
  const planner::PlanResult plan = planner::plan(asked, {});
  if (plan.outcome != planner::PlanOutcome::solved)
    throw std::runtime_error(std::string(kCommand) + ": " + plan.constraint + ": " + plan.reason);
  Json waypoints = Json::array();
  for (const cable::ThetaVector& theta_rad : plan.waypoints_rad) {
    Json row = Json::array();
    for (std::int32_t k = 0; k < asked.robot.table.theta_count(); ++k)
      row.push_back(theta_rad[static_cast<std::size_t>(k)] / kDegree);
    waypoints.push_back(row);
  }
  return {{"waypoints_deg", waypoints},
          {"tip_off_m", plan.follow->tip_off_m},
          {"curve_off_m", plan.follow->curve_off_m},
          {"curve_off_segment", plan.follow->curve_off_segment},
          {"curve_off_along_m", plan.follow->curve_off_along_m}};
}

}  // namespace liana::mission_runner
