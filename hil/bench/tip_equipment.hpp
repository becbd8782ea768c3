// Camera and tool at the tip of an arm, as the bench runs them: pictures and reports go out, commands come in.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "hil/arm/tip_camera.hpp"
#include "hil/arm/tip_tool.hpp"

namespace liana::bench {

class TipEquipment {
 public:
  TipEquipment() = default;
  TipEquipment(const TipEquipment&) = delete;
  TipEquipment& operator=(const TipEquipment&) = delete;
  virtual ~TipEquipment() = default;

  // What is wrong with them from now on.
  virtual void suffer(const CameraDefects& camera, const ToolDefects& tool) = 0;
  // At the start of a slot: takes a picture if one is due.
  virtual void look(double now_s) = 0;
  // The next picture's message that is due, oldest first.
  virtual std::optional<std::string> picture(double now_s) = 0;
  // A command to the tool.
  virtual void ask(const ToolCommand& command) = 0;
  // At the start of a slot: the tool acts; what it has to say comes out once.
  virtual std::optional<ToolStatus> act(double now_s) = 0;
  // Adds what there is to say at the end.
  virtual void summarise(nlohmann::json& summary) const = 0;
};

}  // namespace liana::bench
