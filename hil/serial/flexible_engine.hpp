// MuJoCo behind a FlexibleChain.
#pragma once

#include "hil/arm/mujoco_model.hpp"
#include "hil/serial/flexible_chain.hpp"

namespace liana::bench {

struct FlexibleChain::Engine : MujocoModel {
  using MujocoModel::MujocoModel;
  const int tip = mj_name2id(model, mjOBJ_BODY, "tip");
  const int base = mj_name2id(model, mjOBJ_BODY, "base_tip");  // -1 where nothing carries
  const int payload = mj_name2id(model, mjOBJ_BODY, "payload");
};

}  // namespace liana::bench
