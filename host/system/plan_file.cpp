#include "host/system/plan_file.hpp"

#include "firmware_like/math/trig.hpp"
#include "host/config/canonical.hpp"
#include "host/config/field.hpp"
#include "host/config/sha256.hpp"
#include "host/json/json.hpp"
#include "host/plan/check/plan_check.hpp"
#include "host/plan/plan_refusal.hpp"
#include "host/system/errors.hpp"
#include "host/system/tables.hpp"

namespace liana::system {
namespace {

constexpr std::size_t kMostWaypoints = 2000;  // a followed curve has as many as it needs
constexpr double kRounding_m = 1e-9;          // of angles that became degrees in between

Json read_plan(const std::string& file) {
  return config::parse_json(config::read_text_file(file), file, "give a file that liana plan --out has written");
}

void check_scene(const std::string& file, const Json& plan, const config::SceneConfig& scene) {
  const Json& of_plan = plan.member_or_null("inputs").member_or_null("scene");
  if (of_plan == Json::parse(scene.canonical_json)) return;
  throw BadInput("--scene: '" + scene.name + "': the plan " + file + " was made for another scene" +
                 (of_plan.is_object() ? ", '" + of_plan.value("name", "") + "'" : "") +
                 "; run it in that one, or plan again");
}

plan::Path read_waypoints(const config::Field& plan, const cable::RobotTable& table) {
  const auto count = static_cast<std::size_t>(table.theta_count());
  const config::Field rows = plan.at("waypoints_deg");
  plan::Path path(rows.size(2, kMostWaypoints, "plan a way, not only its end (--waypoints)"));
  for (std::size_t w = 0; w < path.size(); ++w) {
    rows.element(w).size(count, count, "give an angle for every theta of the robot");
    for (std::size_t k = 0; k < count; ++k) path[w][k] = kDegree * rows.element(w).element(k).number({-180, 180});
  }
  return path;
}

}  // namespace

Json tables_of_plan(const std::string& file) {
  return checked([&] {
    const Json content = read_plan(file);
    const config::Field inputs = config::Field(content, file, "").at("inputs");
    inputs.at("robot").at("name");
    inputs.at("scene").at("name");
    return Json{{"robot", inputs.json().at("robot")}, {"scene", inputs.json().at("scene")}};
  });
}

std::string start_of_plan(const std::string& file) {
  const Json rows = checked([&] { return read_plan(file); }).member_or_null("waypoints_deg");
  std::string angles;
  if (!rows.is_array() || rows.empty() || !rows.front().is_array())
    return angles;  // check_plan_file says what is wrong
  for (const Json& angle_deg : rows.front()) angles += (angles.empty() ? "" : ",") + angle_deg.dump();
  return angles;
}

std::string digest_of_plan(const Json& plan) {
  const Json content{{"outcome", plan.member_or_null("outcome")},
                     {"waypoints_deg", plan.member_or_null("waypoints_deg")},
                     {"inputs", plan.member_or_null("inputs")}};
  return config::sha256_hex(config::canonical_json(content));
}

void check_plan_file(const std::string& file, const config::RobotConfig& robot, const config::SceneConfig& scene) {
  const Json content = checked([&] { return read_plan(file); });
  check_scene(file, content, scene);
  if (content.contains("digest") && content.value("digest", "") != digest_of_plan(content))
    throw BadInput(file +
                   ": digest: the file is not what liana plan wrote, somebody has edited it: allowed a plan as it " +
                   "was checked: plan again");
  const config::Field plan(content, file, "");
  plan::PlanRequest limits;
  limits.robot = robot;
  limits.scene = scene;
  plan::Path path;
  checked([&] {
    const config::Field inputs = plan.at("inputs");
    limits.margin_m = inputs.at("margin_m").number({0, 0.5}) - kRounding_m;
    limits.max_step_rad = kDegree * inputs.at("max_step_deg").number({0, 180, true});
    path = read_waypoints(plan, robot.table);
    return 0;
  });
  const auto refused =
      plan::refusal_of(limits, plan::check_plan(robot, scene, path, plan::plain_tip(robot.table, path.back())));
  if (refused)
    throw BadInput(file + ": waypoints_deg: " + refused->reason +
                   ": the file is not what liana plan wrote: plan again");
}

}  // namespace liana::system
