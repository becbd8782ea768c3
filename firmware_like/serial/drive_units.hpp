// Joint angles and counts of the drives behind them, and what the drives may be told.
#pragma once

#include <cstdint>

#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/gate.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::serial {

constexpr double kRangeMargin_rad =
    0.0175;  // 1 deg: beyond its range by less, a joint is not out of it, for the gate as for homing
constexpr double kFollowingWindow_rad =
    0.00175;  // 0.1 deg at rest: wind-up of the gear at rated torque, and loop error
constexpr double kTorqueFollowingWindow_rad =
    0.035;  // 2 deg, of torque drives: a joint with a payload that nobody has told it of lags when it speeds up
constexpr double kRatedPermille = 1000.0;  // of torque

// Joint angle [rad] at a drive position.
constexpr double joint_at_counts(const DriveParams& drive, std::int32_t counts) noexcept {
  const double turned = static_cast<double>(counts) - static_cast<double>(drive.zero_counts);
  return static_cast<double>(drive.direction) * turned * drive.rad_per_count;
}

// Drive position at a joint angle, not rounded; inverse of joint_at_counts.
constexpr double counts_at_joint(const DriveParams& drive, double joint_rad) noexcept {
  return static_cast<double>(drive.zero_counts) +
         static_cast<double>(drive.direction) * (joint_rad / drive.rad_per_count);
}

// For the gate: the joints' ranges with kRangeMargin_rad, their rates with kTargetSpeedMargin, rated torque; for torque
// drives also how fast rate (kRateChangeShare) and torque (kTorqueRamp_s) may change.
GateLimits make_gate_limits(const RobotParams& table) noexcept;

// For the watchdogs: drives lag by their time constant and the bus at full rate.
LinkLimits make_link_limits(const RobotParams& table) noexcept;

}  // namespace liana::serial
