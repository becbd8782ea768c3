// What the simulation knows of an arm: numbers of the robot table, and assumptions where the table is silent.
#pragma once

#include "host/model/config/config.hpp"

namespace liana::simulation {

using namespace cable;  // what is a serial arm's says so in this room (serial_model.hpp)

// Assumed: the core moves its motors after what the arm swings by, so that every mode decays like c / 2
// (docs/explanation/verification.md).
constexpr double kSwingDamping_1_s = 1.0;
// Links are solid cylinders: mass and length of the table, centre of mass half way.
struct ArmModel {
  RobotParams table{};
  double link_radius_m = 0.0;
  double viscous_Nms_per_rad = 0.0;  // per theta
  double friction_band = 0.0;        // share by which friction may differ from the table's mu
  double swing_damping_1_s = kSwingDamping_1_s;

  std::int32_t links() const {
    std::int32_t count = 0;
    for (std::int32_t m = 0; m < table.segment_count; ++m) count += table.segment[static_cast<std::size_t>(m)].modules;
    return count;
  }
};

// The model of a robot's table.
inline ArmModel arm_model(const config::RobotConfig& robot) {
  return {robot.table, robot.module_radius_m, robot.joint_viscous_Nms_per_rad, robot.friction_band};
}

}  // namespace liana::simulation
