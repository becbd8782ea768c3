// Motion stage: from the telecommand in force to commanded joint angles, once per tick.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/cable/motion/governor.hpp"
#include "firmware_like/cable/motion/limiter.hpp"
#include "firmware_like/cable/motion/servo_ik.hpp"
#include "firmware_like/cable/shape/shape.hpp"
#include "firmware_like/operator_input/tip_interval.hpp"

namespace liana::cable {

// A held theta on its way to its target.
struct HeldProfile {
  double value_rad = 0.0;
  ChannelState channel{};  // [0] only
};

struct MotionState {
  Setpoint from{};                 // where interpolation over the command interval started
  Setpoint to{};                   // the setpoint in force
  Vec3 turn_rad{};                 // rotation of the tip from `from` to `to`, base frame
  std::int32_t interval_tick = 0;  // ticks since `to` came into force
  bool braking = true;             // no valid setpoint: stop along the path
  TipFilterState filter{};
  ThetaVector ik_rad{};  // servo IK solution
  ShapeState shape{};
  std::array<HeldProfile, kMaxTheta> held{};
  std::uint32_t held_mask = 0;
  bool held_at_target = true;
  LimiterState limiter{};
  ChannelState brake{};  // [0]: rate of the fastest joint, and how it changes: by it all come to rest
  ArmTrig trig{};        // of the commanded angles (limiter.theta_rad)
  ArmKinematics arm{};   // at the commanded angles
  IkResult ik{};
  GovernorState governor{};  // of where the command stands, a moment ago
  std::uint32_t limits = 0;  // LimitBit of this tick
};

// What an arm leaves that no governor slows.
inline constexpr GovernorState kUngoverned{};

// Bounds of the tip filter from the robot table; `tip_speed_m_s` may lower the linear speed (0 = the robot's), the
// governor the rest; the config refers to its slow directions.
TipFilterConfig tip_filter_config(const RobotParams& table, double tip_speed_m_s,
                                  const GovernorState& governor = kUngoverned) noexcept;

// Stands still at theta.
void reset_motion(const RobotParams& table, const ThetaVector& theta_rad, MotionState& state) noexcept;

// Takes a new setpoint into force (kTip, kJoint or kRetract); the motion goes on from where it is.
void accept_setpoint(const RobotParams& table, const Setpoint& setpoint, MotionState& state) noexcept;

// One tick. With `allowed` false or braking, everything comes to rest along its path.
void advance_motion(const RobotParams& table, const CableGeometry& geometry, bool allowed, MotionState& state) noexcept;

// Velocity of the commanded tip in the base frame.
struct Twist {
  Vec3 linear_m_s{};
  Vec3 angular_rad_s{};
};
Twist tip_twist(const RobotParams& table, const MotionState& state) noexcept;

// Of the way from the filter to the tip's target, what directions leave that the arm has all but lost (governor.hpp): 1
// where none is, and for joint motion.
double lost_share(const MotionState& state) noexcept;

// True when nothing moves any more.
bool at_rest(const RobotParams& table, const MotionState& state) noexcept;

}  // namespace liana::cable
