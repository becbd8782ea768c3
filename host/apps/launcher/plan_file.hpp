// A plan that is to be carried out, looked at once more: files can be edited.
#pragma once

#include <string>

#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"

namespace liana::launcher {

// The tables that a plan was made with: members robot and scene. Throws BadInput where the file is no plan.
Json tables_of_plan(const std::string& file);

// Where its way begins, as --start-pose takes it; empty where it has no way.
std::string start_of_plan(const std::string& file);

// The plan's way, put to the independent check again (docs/explanation/path-planning.md): its clearance is still
// inputs.margin_m, its steps are within inputs.max_step_deg. `robot`: as for planning. Throws BadInput naming file,
// field and what is wrong: also when the plan was made for another scene, or the file was edited. Cost: about 0.1 s for
// 20 waypoints past a slit.
void check_plan_file(const std::string& file, const config::RobotConfig& robot, const config::SceneConfig& scene);

}  // namespace liana::launcher
