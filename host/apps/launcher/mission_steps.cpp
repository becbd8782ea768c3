#include "host/apps/launcher/mission_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/plan_file.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/apps/launcher/validate_goals.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;

constexpr double kAtStart_deg = 1.0;  // as lua/liana/plan_step.lua

std::vector<double> angles(const Json& list) { return list.get<std::vector<double>>(); }

// The angles that a step goes to, as far as they are known; empty where they are not.
template <class Robot>
std::vector<double> goal_of(const Json& step, const Robot& robot) {
  if (step.contains("goal_deg")) return angles(step.at("goal_deg"));
  const auto pose = robot.named_poses_deg.find(step.value("goal_pose", ""));
  return pose == robot.named_poses_deg.end() ? std::vector<double>() : pose->second;
}

std::string place_of(const Json& step) {
  const std::string pose = step.value("goal_pose", "");
  return !pose.empty() ? "at pose " + pose : step.contains("plan") ? "at the end of its plan" : "at its goal";
}

template <class Robot>
void check_goal(const Json& mission, std::size_t i, const Robot& robot, const config::SceneConfig& scene) {
  const Json& step = mission.at("steps")[i];
  const std::vector<double> goal_deg = goal_of(step, robot);
  const std::string inside = goal_deg.empty() ? "" : inside_body(robot, scene, goal_deg);
  if (inside.empty()) return;
  throw BadInput(step_where(mission, i) + ": " + place_of(step) + " " + inside + " (scene " + scene.name +
                 "): go to another pose, or run in another --scene");
}

void check_unfolded(const Json& mission, std::size_t i, const config::SerialRobotConfig& robot) {
  const Json& step = mission.at("steps")[i];
  const std::vector<double> goal_deg = goal_of(step, robot);
  const std::string inside = goal_deg.empty() ? "" : inside_itself(robot, goal_deg);
  if (!inside.empty())
    throw BadInput(step_where(mission, i) + ": " + place_of(step) + " " + inside + ": go to another pose");
}

// Where the file of a step's plan lies.
std::string plan_path(const Json& mission, const std::string& name) {
  for (const Json& file : mission.at("files")) {
    if (file.value("file", "") == name) return file.value("path", "");
  }
  return name;
}

void check_plan(const Json& mission, std::size_t i, const config::RobotConfig& robot,
                const config::SceneConfig& scene) {
  const std::string name = mission.at("steps")[i].value("plan", "");
  if (name.empty()) return;
  try {
    check_plan_file(plan_path(mission, name), robot, scene);
  } catch (const BadInput& problem) {
    throw BadInput(step_where(mission, i) + ": plan: " + problem.what());
  }
}

void check_start(const Json& mission, const StartPose& start) {
  const Json& first = mission.at("steps")[0];
  if (!first.contains("start_deg")) return;
  const std::vector<double> begin_deg = angles(first.at("start_deg"));
  std::string given;
  for (const double angle_deg : begin_deg) given += (given.empty() ? "" : ",") + Json(angle_deg).dump();
  for (std::size_t k = 0; k < begin_deg.size() && k < start.angles_deg.size(); ++k) {
    if (std::fabs(begin_deg[k] - start.angles_deg[k]) <= kAtStart_deg) continue;
    char text[120];
    std::snprintf(text, sizeof text, ": the plan begins with theta %zu at %g deg, the arm at start pose ", k + 1,
                  begin_deg[k]);
    throw BadInput(step_where(mission, 0) + text + start.text + " with " + Json(start.angles_deg[k]).dump() +
                   ": allowed within 1 deg: begin there (--start-pose=" + given + "), or go there in a step before");
  }
}

bool has_part(const config::SceneConfig& scene, const std::string& name) {
  if (name == "rod") return scene.rod.has_value();
  return name == "payload" ? scene.payload.has_value() : scene.slit.has_value();
}

void check_fixtures(const Json& mission, std::size_t i, const config::SceneConfig& scene) {
  for (const Json& named : mission.at("steps")[i].value("fixtures", Json::array())) {
    const auto is_named = [&](const config::SceneFixture& one) { return one.name == named.text(); };
    if (std::any_of(scene.fixtures.begin(), scene.fixtures.end(), is_named)) continue;
    std::string known;
    for (const config::SceneFixture& one : scene.fixtures) known += (known.empty() ? "" : ", ") + one.name;
    throw BadInput(step_where(mission, i) + ": fixtures: " + named.text() + ": scene " + scene.name + " has " +
                   (known.empty() ? "no fixtures" : known) +
                   ": name one of the scene's, leave it out for all, or run in another --scene");
  }
}

}  // namespace

void check_steps(const Json& mission, const config::RobotConfig& robot, const config::SceneConfig& scene,
                 const StartPose* start) {
  for (std::size_t i = 0; i < mission.at("steps").size(); ++i) {
    check_plan(mission, i, robot, scene);
    check_goal(mission, i, robot, scene);
  }
  if (start != nullptr) check_start(mission, *start);
}

void check_steps(const Json& mission, const config::SerialRobotConfig& robot, const config::SceneConfig& scene) {
  for (std::size_t i = 0; i < mission.at("steps").size(); ++i) {
    check_unfolded(mission, i, robot);
    check_goal(mission, i, robot, scene);
  }
}

void check_scene_parts(const Json& mission, const config::SceneConfig& scene) {
  for (std::size_t i = 0; i < mission.at("steps").size(); ++i) {
    for (const Json& part : mission.at("steps")[i].at("parts")) {
      const std::string name = part.value("part", "");
      if (has_part(scene, name)) continue;
      throw BadInput(step_where(mission, i) + ": " + part.value("field", "") + ": looks at a " + name + ": scene " +
                     scene.name + " has none: run in another --scene, or correct the condition");
    }
    check_fixtures(mission, i, scene);
  }
}

void check_adapter_is_simulated(const Json& mission, const config::SceneConfig& scene) {
  if (scene.adapter) return;
  for (std::size_t i = 0; i < mission.at("steps").size(); ++i) {
    for (const Json& ask : mission.at("steps")[i].at("asks")) {
      if (ask.text() != "adapter") continue;
      throw BadInput(step_where(mission, i) + ": run: adapter: scene " + scene.name +
                     " has none, so none is simulated: run in another --scene, as payload_adapter");
    }
  }
}

void keep_mission_files(const Json& mission, const std::string& directory) {
  for (const Json& file : mission.at("files")) {
    const std::string path = file.value("path", ""), text = checked([&] { return config::read_text_file(path); });
    if (config::sha256_hex(text) != file.value("sha256", ""))
      throw BadInput(path + ": has changed since it was checked; run again");
    const fs::path kept = fs::path(directory) / "mission_files" / file.value("file", "");
    std::error_code error;
    fs::create_directories(kept.parent_path(), error);
    write_output(kept.string(), text);
  }
}

}  // namespace liana::launcher
