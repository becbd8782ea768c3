// What both verification ends ask of one kind of arm: its own limits, tick by tick.
#pragma once

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/control/verification/judge.hpp"

namespace liana::verification {

// Execution: a tick's planned forces, and its targets against those of the tick before (nullptr: there is none).
void judge_targets(const cable::RobotParams& table, const cable::Outputs* before, const cable::Outputs& after,
                   Judge& judge);
void judge_targets(const serial::RobotParams& table, const serial::Outputs* before, const serial::Outputs& after,
                   Judge& judge);

// Motion: angles in their ranges, rates within the limits; of a serial arm that pushes, the tube of the robot's table:
// how far along the axis and beside it, and the set force. (The push's own, narrower tube is the core's: it ends the
// push by name.)
// A cable arm that stands beyond a range already, as of `first`, goes no further out.
void judge_joints(const cable::RobotParams& table, const cable::Outputs& first, const cable::Outputs& outputs,
                  Judge& judge);
void judge_joints(const serial::RobotParams& table, const serial::Outputs& first, const serial::Outputs& outputs,
                  Judge& judge);

// The tip's own limits.
struct TipRates {
  double speed_m_s = 0.0;
  double rate_rad_s = 0.0;
};
inline TipRates tip_rates(const cable::RobotParams& table) {
  return {table.limits.tip_speed_m_s, table.limits.tip_rate_rad_s};
}
inline TipRates tip_rates(const serial::RobotParams& table) { return {table.tip.speed_m_s, table.tip.rate_rad_s}; }

}  // namespace liana::verification
