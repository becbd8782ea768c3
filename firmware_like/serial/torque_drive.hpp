// What torque drives are told: per joint a rate that the drive damps against, and a torque beside it.
#pragma once

#include "firmware_like/serial/dynamics.hpp"
#include "firmware_like/serial/limiter.hpp"
#include "firmware_like/serial/push.hpp"

namespace liana::serial {

constexpr double kTorqueRamp_s = 0.1;     // from rated torque to none, and so for every change of the feed-forward
constexpr double kRateChangeShare = 8.0;  // of a joint's acceleration: contact is quicker than planned motion
constexpr double kFollowAlong = 0.1;      // of what a target is off the joint, in a tick in which forces move it

struct TorqueTold {
  JointVector rate_rad_s{};
  JointVector torque_Nm{};
  JointVector planned_rad_s{};  // the target's own rate, of which the change is the planned acceleration
};

// Rated torque [N.m] at the joint.
constexpr double rated_Nm(const DriveParams& drive) noexcept { return 1000.0 * drive.torque_per_permille_Nm; }

// Planned motion: the target's rate and position_gain_per_s of what is missing to it, and the torque that moving the
// links takes.
ForceMotion planned_motion(const RobotParams& table, const Dynamics& dynamics, const LimiterState& target,
                           const TorqueTold& told) noexcept;

// The target of joints that forces move: it goes with them, no quicker than their rates, so that nothing jumps when
// they are led again. One that holds its place goes by the wanted rate alone.
void follow_along(const RobotParams& table, const ForceMotion& wanted, const JointVector& measured_rad,
                  LimiterState& target) noexcept;

// What the drives are told for `wanted`, within what they may be told; joints that hold their places are drawn to the
// target.
void tell_torque(const RobotParams& table, const ForceMotion& wanted, const JointVector& measured_rad,
                 const LimiterState& target, TorqueTold& told) noexcept;

}  // namespace liana::serial
