// What the arm really is, as opposed to what the table says: drawn from the seed (mission, A9).
#pragma once

#include <cstdint>
#include <string>

#include "hil/arm/linkage.hpp"
#include "hil/config/robot_config.hpp"
#include "hil/math/reduced.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

struct TrueParameters {
  double EA_N = 0.0;
  double mu = 0.0;
  double hole_radius_error_m = 0.0;  // of all holes alike
  Vec3 gravity_m_s2;                 // in the base frame: the table's, and what --gravity leaves along -z
  Linkage linkage;                   // empty: all joints of a segment bend alike
  CableValues zero_offset_m{};       // per drive: payout beyond what counts and table say
  CableValues torque_gain{};         // measured / true drive torque
};

// The table's own values; `physics` names one of its friction_mu; throws std::runtime_error for an unknown name.
TrueParameters table_parameters(const RobotConfig& robot, const std::string& physics);
// EA +-5 %, mu +-20 %, hole radius +-0.02 mm (one draw each), cable zero +-0.05 mm and torque gain +-1 % per cable.
// A base is as its table says.
TrueParameters spread_parameters(const RobotConfig& robot, const std::string& physics, std::uint64_t seed);
// The arm as it was built. Of one with weight or springs: masses +-5 % and their centers +-5 mm (each segment, the
// tool), joint stiffness +-10 % (each segment), gravity turned by 1 deg at most; of any other what the table says.
RobotConfig spread_load(const RobotConfig& robot, std::uint64_t seed);
// Named pose, or angles in degrees, plus uniform +-`spread_rad` per angle; throws std::runtime_error for anything else.
Theta start_pose(const RobotConfig& robot, const std::string& name, double spread_rad, std::uint64_t seed);

}  // namespace liana::bench
