// Motion stage of a serial arm: from the setpoint in force to commanded joints, once per tick.
#pragma once

#include <cstdint>

#include "firmware_like/operator_input/tip_interval.hpp"
#include "firmware_like/serial/kinematics.hpp"
#include "firmware_like/serial/limiter.hpp"
#include "firmware_like/serial/servo_ik.hpp"
#include "firmware_like/serial/setpoint.hpp"

namespace liana::serial {

constexpr double kCentringShare =
    0.25;  // of a joint's rate, towards the middle of its range, at the ends of it and at full tip speed

struct MotionState {
  Setpoint from{};                 // where interpolation over the command interval started
  Setpoint to{};                   // the setpoint in force
  Vec3 turn_rad{};                 // rotation of the tip from `from` to `to`, base frame
  std::int32_t interval_tick = 0;  // ticks since `to` came into force
  bool braking = true;             // no valid setpoint: stop along the path
  TipFilterState filter{};
  JointVector ik_rad{};  // what the limiter is asked for
  LimiterState limiter{};
  ArmKinematics arm{};  // at the commanded joints
  IkResult ik{};
  std::uint32_t limits = 0;  // LimitBit of this tick
};

// Stands still at the joint angles.
void reset_motion(const RobotParams& table, const JointVector& joint_rad, MotionState& state) noexcept;

// Takes a usable setpoint into force (kTip, kJoint or kRetract); the motion goes on from where it is.
void accept_setpoint(const RobotParams& table, const Setpoint& setpoint, MotionState& state) noexcept;

// One tick. With `allowed` false or braking, everything comes to rest along its path. The arm turns about the line that
// the tip leaves free only while the tip moves: a tip that rests means an arm that rests.
void advance_motion(const RobotParams& table, bool allowed, MotionState& state) noexcept;

// True when nothing moves any more.
bool at_rest(const RobotParams& table, const MotionState& state) noexcept;

}  // namespace liana::serial
