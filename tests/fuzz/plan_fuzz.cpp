// Plans that are to be carried out, up to the check of their way. Scene and digest would stop nearly all of them at the
// door, so they are made right here, as whoever wants to do harm would.
#include "host/apps/launcher/planned_path_check.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/host/model/config/tables.hpp"

using namespace liana;

namespace {

void read(Json plan, const config::RobotConfig& arm, const config::SceneConfig& scene) {
  static const Json kScene = Json::parse(scene.canonical_json);
  if (plan.is_object() && plan.member_or_null("inputs").is_object() && plan["inputs"].contains("scene"))
    plan["inputs"]["scene"] = kScene;
  if (plan.is_object() && plan.contains("digest")) plan["digest"] = launcher::digest_of_plan(plan);
  launcher::start_of_plan(plan);
  launcher::way_of_plan(plan, "plan", arm, scene);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const config::RobotConfig kArm = config::nominal_zhu2022();
  static const config::SceneConfig kScene =
      config::parse_scene(config::good_table("scene", "panel_slit").dump(), "scene");
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::refusing([&] { launcher::tables_of_plan(Json::parse(text), "plan"); });
  return fuzz::refusing([&] { read(Json::parse(text), kArm, kScene); });
}
