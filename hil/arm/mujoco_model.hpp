// A MuJoCo model and its data, made from XML text.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

namespace liana::bench {

struct MujocoModel {
  // Throws std::runtime_error when MuJoCo refuses the text.
  explicit MujocoModel(const std::string& xml);
  ~MujocoModel();
  MujocoModel(const MujocoModel&) = delete;
  MujocoModel& operator=(const MujocoModel&) = delete;

  mjModel* model = nullptr;
  mjData* data = nullptr;
};

}  // namespace liana::bench
