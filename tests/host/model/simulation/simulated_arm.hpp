// The source's arm as the simulation knows it, for its tests.
#pragma once

#include "host/model/simulation/arm_model.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::simulation {

inline ArmModel model_of(const cable::RobotParams& table) { return {table, 0.03, 0.4, 0.2, kSwingDamping_1_s}; }
inline ArmModel zhu2022_model() { return model_of(cable::zhu2022::table()); }

}  // namespace liana::simulation
