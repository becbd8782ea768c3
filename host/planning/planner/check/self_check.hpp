// The arm against itself: a part of the independent check (plan_check.hpp), by the same plain chain of joints.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/model/config/config.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

// Least distance between two links' surfaces, negative: depth of overlap along the shortest line between their axes.
// Links nearer along the arm than half a turn at the joint limits cannot touch and do not count.
struct SelfClearance {
  double clearance_m = 1e3;          // 1e3 where no two links count
  std::array<std::int32_t, 2> link;  // from 1; 0 where no two links count
};

// "link 24 is 12.00 mm from link 3 of the arm itself", for messages.
std::string nearest_text(const SelfClearance& self);

// Least that a plan has to keep. The arm's own margin to obstacles is for their place in the base frame; its links'
// places to each other are known better.
constexpr double kSelfMargin_m = 0.001;

// At one pose. Cost: about 500 pairs of links, 40 us.
SelfClearance self_clearance(const config::RobotConfig& robot, const ThetaVector& theta_rad);

// Along a path, certain to kUnseen_m where it is below kSelfNear_m; above, the least of the waypoints and the poses
// looked at.
constexpr double kSelfNear_m = 0.05;
SelfClearance self_clearance_along(const config::RobotConfig& robot, const std::vector<ThetaVector>& path);

}  // namespace liana::planner
