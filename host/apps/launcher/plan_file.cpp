#include "host/apps/launcher/plan_file.hpp"

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/planned_path_check.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/model/config/field.hpp"
#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/plan_refusal.hpp"

namespace liana::launcher {
namespace {

Json read_plan(const std::string& file) {
  return config::parse_json(config::read_text_file(file), file, "give a file that liana plan --out has written");
}

}  // namespace

Json tables_of_plan(const std::string& file) {
  return checked([&] { return tables_of_plan(read_plan(file), file); });
}

std::string start_of_plan(const std::string& file) {
  return start_of_plan(checked([&] { return read_plan(file); }));
}

void check_plan_file(const std::string& file, const config::RobotConfig& robot, const config::SceneConfig& scene) {
  const PlannedPathCheck way = checked([&] { return way_of_plan(read_plan(file), file, robot, scene); });
  planner::PlanRequest limits;
  limits.robot = robot;
  limits.scene = scene;
  limits.margin_m = way.margin_m;
  limits.max_step_rad = way.max_step_rad;
  const auto refused = planner::refusal_of(
      limits, planner::check_plan(robot, scene, way.path, planner::plain_tip(robot.table, way.path.back())));
  if (refused)
    throw BadInput(file + ": waypoints_deg: " + refused->reason +
                   ": the file is not what liana plan wrote: plan again");
}

}  // namespace liana::launcher
