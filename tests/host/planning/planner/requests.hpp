// Plans to ask for, in tests.
#pragma once

#include "host/planning/planner/plan.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::planner {

inline config::RobotConfig the_robot() { return config::nominal_zhu2022(); }

// No more than what is checked of an arm.
inline config::RobotConfig robot_of(const RobotParams& table) {
  config::RobotConfig robot;
  robot.table = table;
  robot.module_radius_m = 0.03;
  return robot;
}

inline PlanRequest request_between(const zhu2022::Degrees& from_deg, const zhu2022::Degrees& to_deg,
                                   const config::SceneConfig& scene) {
  PlanRequest request;
  request.robot = the_robot();
  request.scene = scene;
  request.from_rad = zhu2022::radians(from_deg);
  request.to_rad = zhu2022::radians(to_deg);
  request.max_step_rad = default_max_step_rad(request.robot.table, request.waypoints);
  return request;
}

inline config::SceneConfig panel_slit() {
  return config::parse_scene(config::good_table("scene", "panel_slit").dump(), "s");
}

}  // namespace liana::planner
