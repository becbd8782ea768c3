// Rate and acceleration limiter: the commanded angles follow the IK's within the robot's limits, exactly when they can.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/cable/motion/governor.hpp"

namespace liana::cable {

struct LimiterState {
  ThetaVector theta_rad{};      // commanded
  ThetaVector rate_rad_s{};     // of the command
  ThetaVector reference_rad{};  // what was asked in the last tick
  std::uint32_t limits = 0;     // LimitBit: rate, acceleration, cable speed
};

// Starts at rest at theta.
void reset_limiter(const ThetaVector& theta_rad, LimiterState& state) noexcept;

// Share (0..1) of a step of one tick [rad] that rate, cable speed, acceleration and the room for it allow, and the
// LimitBits that keep it below 1. Whoever takes only this share of his motion slows down on his path instead of being
// left behind by the limiter. Joints that would have to brake harder than they can come before joints that would have
// to speed up faster.
struct StepShare {
  double share = 1.0;
  std::uint32_t limits = 0;
};
StepShare allowed_share(const RobotParams& table, const CableGeometry& geometry, const ThetaVector& step_rad,
                        const GovernorState& governor, const LimiterState& state) noexcept;

// One tick towards `reference` (which may move). Follows exactly while its rate and acceleration are inside the limits;
// otherwise it lags and comes back along a braking parabola, past a standing reference by accel tick^2 / 8 at most
// (8e-6 deg), and never past a joint limit. `geometry` is the cable Jacobian for the cable speed limit, which is not
// looked at again while a reference that was `judged` by allowed_share is followed exactly. Below 1, `rate_share` of
// the rate limit is all that the fastest joint gets; the others slow down in proportion.
void limit_motion(const RobotParams& table, const CableGeometry& geometry, const ThetaVector& reference_rad,
                  LimiterState& state, bool judged = false, double rate_share = 1.0) noexcept;

// Largest |rate| of the command [rad/s].
double largest_rate(const RobotParams& table, const LimiterState& state) noexcept;

}  // namespace liana::cable
