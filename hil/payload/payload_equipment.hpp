// What an arm that installs a payload has at its tip: the camera that sees its target, the end effector that takes the
// payload; and below it the arm that carries it to the site.
#pragma once

#include "hil/bench/tip_equipment.hpp"
#include "hil/payload/carrier.hpp"
#include "hil/payload/grapple.hpp"
#include "hil/payload/target_camera.hpp"
#include "hil/payload/torque_plant.hpp"

namespace liana::bench {

class PayloadEquipment final : public TipEquipment {
 public:
  // `plant` has a payload and outlives this.
  PayloadEquipment(const CameraConfig& camera, TorquePlant& plant, bool spread, std::uint64_t seed);

  void suffer(const CameraDefects& camera, const ToolDefects& tool) override;
  void look(double now_s) override;
  std::optional<std::string> picture(double now_s) override;
  void ask(const ToolCommand& command) override;
  std::optional<ToolStatus> act(double now_s) override;
  void summarise(nlohmann::json& summary) const override;

 private:
  Lens lens() const;
  std::optional<ToolStatus> carry(double now_s);

  TorquePlant& plant_;
  TargetCamera camera_;
  Grapple grapple_;
  Carrier carrier_;
  bool carries_ = false;  // the last command was for the arm that carries
};

}  // namespace liana::bench
