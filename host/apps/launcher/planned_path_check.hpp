// What a plan's content says, without the check of its way.
#pragma once

#include <string>

#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/planning/planner/plan.hpp"

namespace liana::launcher {

struct PlannedPathCheck {
  planner::Path path;         // as many angles as the robot has
  double margin_m = 0.0;      // to keep from everything
  double max_step_rad = 0.0;  // from one waypoint to the next
};

// The tables that a plan was made with: members robot and scene. Throws std::runtime_error where it is no plan; `file`
// is how messages call it.
Json tables_of_plan(const Json& plan, const std::string& file);

// Where its way begins, as --start-pose takes it; empty where it has no way.
std::string start_of_plan(const Json& plan);

// SHA-256 over outcome, way and inputs of a plan as its file has them: the file's `digest`, by which it is seen that
// the file has been edited.
std::string digest_of_plan(const Json& plan);

// The way. Throws std::runtime_error naming file, field and what is wrong: also when the plan was made for another
// scene, or the file was edited.
PlannedPathCheck way_of_plan(const Json& plan, const std::string& file, const config::RobotConfig& robot,
                             const config::SceneConfig& scene);

}  // namespace liana::launcher
