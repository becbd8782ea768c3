#include "hil/bench/rod_equipment.hpp"

#include <nlohmann/json.hpp>

namespace liana::bench {

RodEquipment::RodEquipment(const SceneConfig& scene, Plant& plant, std::uint64_t seed)
    : rod_(scene.rod), plant_(plant), camera_(scene.camera, scene.slit_frame, scene.rod.pose, seed) {}

void RodEquipment::suffer(const CameraDefects& camera, const ToolDefects& tool) {
  camera_.suffer(camera);
  tool_.suffer(tool);
}

std::optional<std::string> RodEquipment::picture(double now_s) {
  const auto view = camera_.deliver(now_s);
  if (!view) return std::nullopt;
  return camera_message(*view);
}

std::optional<ToolStatus> RodEquipment::act(double now_s) {
  const auto report = tool_.act(now_s, plant_.tip().position_m, rod_.pose.position_m);
  if (!report || !tool_.has_rod()) return report;
  plant_.remove_rod();
  camera_.lose_rod();
  return report;
}

void RodEquipment::summarise(nlohmann::json& summary) const {
  const Vec3& p = rod_.pose.position_m;
  const Quat& q = rod_.pose.attitude;
  summary["rod"] = {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
  summary["tool"] = {{"number", tool_.last().number},
                     {"phase", tool_.last().phase},
                     {"reason", tool_.last().reason},
                     {"has_rod", tool_.has_rod()}};
}

}  // namespace liana::bench
