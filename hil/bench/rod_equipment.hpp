// What an arm in the slit's scene has at its tip: the camera that sees slit and rod, the tool that takes the rod out.
#pragma once

#include "hil/bench/plant.hpp"
#include "hil/bench/tip_equipment.hpp"
#include "hil/config/scene_config.hpp"

namespace liana::bench {

class RodEquipment final : public TipEquipment {
 public:
  // `scene` as it really is; `plant` outlives this.
  RodEquipment(const SceneConfig& scene, Plant& plant, std::uint64_t seed);

  void suffer(const CameraDefects& camera, const ToolDefects& tool) override;
  void look(double now_s) override { camera_.look(now_s, plant_.tip()); }
  std::optional<std::string> picture(double now_s) override;
  void ask(const ToolCommand& command) override { tool_.ask(command); }
  std::optional<ToolStatus> act(double now_s) override;
  void summarise(nlohmann::json& summary) const override;

 private:
  RodConfig rod_;
  Plant& plant_;
  TipCamera camera_;
  TipTool tool_;
};

}  // namespace liana::bench
