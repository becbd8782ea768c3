// What a serial arm really is, as opposed to what the table says: drawn from the seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/config/serial_config.hpp"

namespace liana::bench {

struct TrueArm {
  SerialRobotConfig robot;              // with the true lengths
  std::vector<double> zero_offset_rad;  // joint angle beyond what counts and table say
  std::vector<double> torque_gain;      // measured / true drive torque
  std::vector<double> start_rad;        // true joint angles at the start
};

// Assumed, so that the tip of micro is some millimetres from where its encoders say (the source states 10 mm): zeros
// +-0.05 deg, lengths +-0.5 mm, torque gain +-1 %, start pose +-0.5 deg (not in a fixture); without `spread` the table
// exactly. Throws std::runtime_error for an unknown pose.
TrueArm true_arm(const SerialRobotConfig& robot, const std::string& start_pose, bool spread, bool fixture,
                 std::uint64_t seed);

}  // namespace liana::bench
