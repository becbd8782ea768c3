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

// The tensions that hold weight and springs where the arm comes to rest, `ends`: the plan in force is cut off at the
// ceiling. An arm that stands beyond it already, `now`, may go where they are no higher. Cost: two tension plans, of an
// arm without such a load nothing.
void judge_hold(const cable::RobotParams& table, const cable::Outputs& now, const cable::Outputs& ends, Judge& judge);
inline void judge_hold(const serial::RobotParams&, const serial::Outputs&, const serial::Outputs&, Judge&) {}

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
