// What is known of a mission's steps before it starts, looked at with robot and scene.
#pragma once

#include <string>

#include "host/apps/launcher/start_pose.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"

namespace liana::launcher {

// `mission` is the description of one (lua/liana/check.lua). Throws BadInput naming line, step, body and link: where a
// pose that a step goes to lies inside a body of the scene; where a plan was made for another scene or does not keep
// what it says; where the first step is a plan that begins elsewhere than the simulated arm (`start`, null on real
// drives). Cost: about 5 ms for each pose, 0.1 s for each plan.
void check_steps(const Json& mission, const config::RobotConfig& robot, const config::SceneConfig& scene,
                 const StartPose* start);
// Of a serial arm: the poses that steps go to.
void check_steps(const Json& mission, const config::SerialRobotConfig& robot, const config::SceneConfig& scene);

// What a mission's conditions look at (a rod, a slit), and the fixtures that its steps name, have to be in the scene.
// Throws BadInput naming line, step and field.
void check_scene_parts(const Json& mission, const config::SceneConfig& scene);

// A simulated adapter is there where the scene has one. Throws BadInput naming line and step that tells it something
// where there is none.
void check_adapter_is_simulated(const Json& mission, const config::SceneConfig& scene);

// Copies the files that a mission is made of to the folder `mission_files` of a run. Throws BadInput where one has
// changed since it was checked.
void keep_mission_files(const Json& mission, const std::string& directory);

}  // namespace liana::launcher
