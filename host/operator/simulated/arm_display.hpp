// The display's picture of the arm: measured angles become the drawn axis, as the console's page draws it.
#pragma once

#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "host/operator/simulated/arm_observation.hpp"

namespace liana::simulated {

class ArmDisplay {
 public:
  // `radius_m`: half the thickness of the links.
  ArmDisplay(const cable::RobotParams& table, double radius_m) : table_(table), radius_m_(radius_m) {}

  // The arm at these angles [deg], with the end of segment `node` (1..segments) marked. Throws std::runtime_error
  // when there are not as many angles as the arm has, or no such node.
  ArmObservation picture(const std::vector<double>& measured_deg, std::size_t node) const;

 private:
  cable::RobotParams table_;
  double radius_m_;
};

}  // namespace liana::simulated
