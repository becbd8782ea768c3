#include "host/apps/launcher/planned_path_check.hpp"

#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::launcher {
namespace {

constexpr std::size_t kMaxPlanRows = 2000;  // a followed curve has as many as it needs
constexpr double kRounding_m = 1e-9;        // of angles that became degrees in between

void check_scene(const std::string& file, const Json& plan, const config::SceneConfig& scene) {
  const Json& of_plan = plan.member_or_null("inputs").member_or_null("scene");
  if (of_plan == Json::parse(scene.canonical_json)) return;
  throw BadInput("--scene: '" + scene.name + "': the plan " + file + " was made for another scene" +
                 (of_plan.is_object() ? ", '" + of_plan.value("name", "") + "'" : "") +
                 "; run it in that one, or plan again");
}

// Of plans written before their hash was under the digest.
std::string digest_without_hash(Json plan) {
  plan.erase("hash");
  return digest_of_plan(plan);
}

void check_digest(const std::string& file, const Json& plan) {
  if (!plan.contains("digest")) return;
  const std::string digest = plan.value("digest", "");
  if (digest == digest_of_plan(plan) || digest == digest_without_hash(plan)) return;
  throw BadInput(file +
                 ": digest: the file is not what liana plan wrote, somebody has edited it: allowed a plan as it " +
                 "was checked: plan again");
}

planner::Path read_waypoints(const config::Field& plan, const cable::RobotParams& table) {
  const auto count = static_cast<std::size_t>(table.theta_count());
  const config::Field rows = plan.at("waypoints_deg");
  planner::Path path(rows.size(2, kMaxPlanRows, "plan a way, not only its end (--waypoints)"));
  for (std::size_t w = 0; w < path.size(); ++w) {
    rows.element(w).size(count, count, "give an angle for every theta of the robot");
    for (std::size_t k = 0; k < count; ++k) path[w][k] = kDegree * rows.element(w).element(k).number({-180, 180});
  }
  return path;
}

}  // namespace

Json tables_of_plan(const Json& plan, const std::string& file) {
  const config::Field inputs = config::Field(plan, file, "").at("inputs");
  inputs.at("robot").at("name");
  inputs.at("scene").at("name");
  return Json{{"robot", inputs.json().at("robot")}, {"scene", inputs.json().at("scene")}};
}

std::string start_of_plan(const Json& plan) {
  const Json& rows = plan.member_or_null("waypoints_deg");
  std::string angles;
  if (!rows.is_array() || rows.empty() || !rows.front().is_array()) return angles;  // way_of_plan says what is wrong
  for (const Json& angle_deg : rows.front()) angles += (angles.empty() ? "" : ",") + angle_deg.dump();
  return angles;
}

std::string digest_of_plan(const Json& plan) {
  Json content{{"outcome", plan.member_or_null("outcome")},
               {"waypoints_deg", plan.member_or_null("waypoints_deg")},
               {"inputs", plan.member_or_null("inputs")}};
  if (plan.contains("hash")) content["hash"] = plan.at("hash");
  return config::sha256_hex(config::canonical_json(content));
}

PlannedPathCheck way_of_plan(const Json& plan, const std::string& file, const config::RobotConfig& robot,
                             const config::SceneConfig& scene) {
  check_scene(file, plan, scene);
  check_digest(file, plan);
  const config::Field whole(plan, file, "");
  whole.only({"outcome", "waypoints_deg", "objective", "iterations", "rounds", "settled", "time_s", "start", "checked",
              "hash", "follow", "constraint", "reason", "inputs", "digest"});
  const config::Field inputs = whole.at("inputs");
  PlannedPathCheck way;
  way.margin_m = inputs.at("margin_m").number({0, 0.5}) - kRounding_m;
  way.max_step_rad = kDegree * inputs.at("max_step_deg").number({0, 180, true});
  way.path = read_waypoints(whole, robot.table);
  return way;
}

}  // namespace liana::launcher
