#include "firmware_like/serial/torque_drive.hpp"

#include "firmware_like/math/scalar.hpp"

namespace liana::serial {
namespace {

using Index = std::size_t;

constexpr double kMaxRateShare = 1.2;     // of a joint's rate, for what leads it back to its target
constexpr double kMaxTorqueShare = 0.99;  // of rated torque: the gate refuses more than all of it

}  // namespace

ForceMotion planned_motion(const RobotParams& table, const Dynamics& dynamics, const LimiterState& target,
                           const TorqueTold& told) noexcept {
  JointMotion motion{target.joint_rad, target.rate_rad_s, {}};
  for (Index i = 0; i < table.joints(); ++i) {
    motion.accel_rad_s2[i] = (target.rate_rad_s[i] - told.planned_rad_s[i]) / table.tick_s;
  }
  return {target.rate_rad_s, dynamics.torque_Nm(motion, {}), true};
}

void follow_along(const RobotParams& table, const ForceMotion& wanted, const JointVector& measured_rad,
                  LimiterState& target) noexcept {
  for (Index i = 0; i < table.joints(); ++i) {
    const JointParams& joint = table.joint[i];
    const double max_rad = joint.rate_rad_s * table.tick_s;  // a target told quicker would be refused
    double step_rad = wanted.rate_rad_s[i] * table.tick_s;
    if (!wanted.holds_place) step_rad += kFollowAlong * (measured_rad[i] - target.joint_rad[i]);
    const double next_rad = target.joint_rad[i] + clamp(step_rad, -max_rad, max_rad);
    target.joint_rad[i] = clamp(next_rad, joint.low_rad, joint.high_rad);
    target.rate_rad_s[i] = wanted.rate_rad_s[i];
  }
  target.reference_rad = target.joint_rad;
  target.limits = 0;
}

void tell_torque(const RobotParams& table, const ForceMotion& wanted, const JointVector& measured_rad,
                 const LimiterState& target, TorqueTold& told) noexcept {
  for (Index i = 0; i < table.joints(); ++i) {
    const JointParams& joint = table.joint[i];
    double rate = wanted.rate_rad_s[i];
    if (wanted.holds_place) rate += table.torque.position_gain_per_s * (target.joint_rad[i] - measured_rad[i]);
    const double most = kMaxRateShare * joint.rate_rad_s;
    const double rate_step = kRateChangeShare * joint.accel_rad_s2 * table.tick_s;
    rate = clamp(clamp(rate, -most, most), told.rate_rad_s[i] - rate_step, told.rate_rad_s[i] + rate_step);
    const double rated = rated_Nm(table.drive[i]), torque_step = rated * table.tick_s / kTorqueRamp_s;
    const double torque = clamp(wanted.torque_Nm[i], -kMaxTorqueShare * rated, kMaxTorqueShare * rated);
    told.rate_rad_s[i] = rate;
    told.torque_Nm[i] = clamp(torque, told.torque_Nm[i] - torque_step, told.torque_Nm[i] + torque_step);
  }
  told.planned_rad_s = target.rate_rad_s;
}

}  // namespace liana::serial
