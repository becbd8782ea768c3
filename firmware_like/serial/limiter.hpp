// Rate and acceleration limiter of a serial arm: the commanded joints follow what motion asks within the robot's
// limits, exactly when they can.
#pragma once

#include <cstdint>

#include "firmware_like/serial/robot_params.hpp"

namespace liana::serial {

struct LimiterState {
  JointVector joint_rad{};      // commanded
  JointVector rate_rad_s{};     // of the command
  JointVector reference_rad{};  // what was asked in the last tick
  std::uint32_t limits = 0;     // LimitBit: range, rate, acceleration
};

// Starts at rest at the joint angles.
void reset_limiter(const JointVector& joint_rad, LimiterState& state) noexcept;

// Share (0..1) of a step of one tick [rad] that rates and accelerations allow, and the LimitBits that keep it below 1.
// Whoever takes only this share of his motion slows down on his path instead of being left behind. Joints that would
// have to brake harder than they can come before joints that would have to speed up faster.
struct StepShare {
  double share = 1.0;
  std::uint32_t limits = 0;
};
StepShare allowed_share(const RobotParams& table, const JointVector& step_rad, const LimiterState& state) noexcept;

// One tick towards a reference (which may move). Follows exactly while its rate and acceleration are inside the limits;
// otherwise it lags and comes back along a braking parabola; it never leaves a joint's range. Below 1, `rate_share` of
// its rate limit is all that the joint gets that is nearest to it; the others slow down in proportion.
void limit_motion(const RobotParams& table, const JointVector& reference_rad, LimiterState& state,
                  double rate_share = 1.0) noexcept;

// The joints of the next tick when all brake in proportion: as hard as the one that needs longest may. They come to
// rest together, so the arm stays on its path; joints that stop one by one would let the tip swing aside.
JointVector braked_joints(const RobotParams& table, const LimiterState& state) noexcept;

// Largest |rate| of the command [rad/s].
double largest_rate(const RobotParams& table, const LimiterState& state) noexcept;

}  // namespace liana::serial
