// How evenly the linkage cables of a segment share its bend among its universal joints (mission, A1: all alike).
#pragma once

#include <cstdint>
#include <vector>

#include "hil/config/robot_config.hpp"

namespace liana::bench {

// What one universal joint bends by, as a share of the mean over its segment's joints.
struct BendShare {
  double pitch = 1.0;
  double yaw = 1.0;
};

// Per module, from the base. Empty: all joints of a segment bend alike.
using Linkage = std::vector<BendShare>;

// Shares uniform within 1 +- `max_share` by seed, the mean of every segment exactly 1 on each axis; empty for 0.
Linkage uneven_linkage(const RobotConfig& robot, double max_share, std::uint64_t seed);

}  // namespace liana::bench
