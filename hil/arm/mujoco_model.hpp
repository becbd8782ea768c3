// A MuJoCo model and its data, made from XML text.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

namespace liana::bench {

// The name by which another file of a model includes its file `i`.
inline std::string mjcf_name(std::size_t i) { return "arm_" + std::to_string(i) + ".xml"; }

struct MujocoModel {
  // The first file is the model, the others what it includes. Throws std::runtime_error when MuJoCo refuses the text.
  explicit MujocoModel(const std::vector<std::string>& files);
  explicit MujocoModel(const std::string& xml) : MujocoModel(std::vector{xml}) {}
  ~MujocoModel();
  MujocoModel(const MujocoModel&) = delete;
  MujocoModel& operator=(const MujocoModel&) = delete;

  mjModel* model = nullptr;
  mjData* data = nullptr;
};

}  // namespace liana::bench
