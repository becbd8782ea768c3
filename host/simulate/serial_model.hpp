// What the simulation knows of a serial arm: its rows, how thick it is, and the arm that it stands on.
#pragma once

#include <string>
#include <vector>

#include "host/clearance/clearance.hpp"
#include "host/config/serial_robot.hpp"

namespace liana::simulate {

struct SerialModel {
  serial::RobotTable table{};
  double link_radius_m = 0.0;  // of the capsules of every link
  // Links of the arm that it stands on, whose joints are locked, from the root on; frame of this arm's base. A link may
  // be two of them: `of_link` says which one (0-based).
  std::vector<clearance::Capsule> base;
  std::vector<std::int32_t> base_of_link;
  std::string base_name;
};

// The model of a robot's table.
SerialModel serial_model(const config::SerialRobotConfig& robot);

}  // namespace liana::simulate
