// What the drives of a cable arm may be told, derived once from the robot table.
#pragma once

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/gate.hpp"

namespace liana::cable {

constexpr std::int64_t kGateRoundingCounts = 1;  // half a count of rounding at either end
constexpr double kFollowingWindow_m = 0.2e-3;    // at rest: drive resolution, loop error and elasticity of the drum

// For the gate. `zero_payout_m` per cable: path at the zero pose plus lead. The range is what bending every joint fully
// can add or take, plus the elongation at the hard limit; torque is the planned tension, from none to the ceiling of
// free motion.
GateLimits make_gate_limits(const RobotParams& table, const CableVector& zero_payout_m) noexcept;

// For the watchdogs: drives lag by their time constant and the bus at full cable speed.
LinkLimits make_link_limits(const RobotParams& table) noexcept;

}  // namespace liana::cable
