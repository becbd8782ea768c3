#include "firmware_like/serial/setpoint.hpp"

#include "firmware_like/math/scalar.hpp"

namespace liana::serial {
namespace {

bool inside_ranges(const RobotParams& table, const JointVector& joint_rad) noexcept {
  for (std::size_t i = 0; i < table.joints(); ++i) {
    if (!(joint_rad[i] >= table.joint[i].low_rad && joint_rad[i] <= table.joint[i].high_rad))
      return false;  // NaN is outside
  }
  return true;
}

bool is_within(double value, double low, double high) noexcept { return value >= low && value <= high; }

bool is_usable(const TorqueParams& table, const Push& push) noexcept {
  for (std::size_t i = 0; i < kPushGainCount; ++i) {
    if (!is_within(push.gains[i], table.gain_low[i], table.gain_high[i])) return false;
  }
  const double axis = dot(push.axis_in_tip, push.axis_in_tip);
  return push.number > 0 && is_within(axis, 1.0 - 2e-6, 1.0 + 2e-6) &&
         is_within(push.force_N, 0.0, table.most_force_N) && is_within(push.travel_m, 0.0, table.most_travel_m) &&
         is_within(push.aside_m, 0.0, table.most_aside_m) && is_within(push.turn_rad, 0.0, table.most_turn_rad) &&
         is_within(push.depth_m, 0.0, push.travel_m);
}

}  // namespace

bool is_usable(const RobotParams& table, const Setpoint& setpoint) noexcept {
  if (!is_body(setpoint.payload_at_tip)) return false;
  if (is_joint(setpoint.kind)) return inside_ranges(table, setpoint.joint_rad);
  if (is_force(setpoint.kind) && table.torque.is_torque_controlled == 0) return false;
  if (setpoint.kind == CommandKind::kPush) return is_usable(table.torque, setpoint.push);
  if (setpoint.kind != CommandKind::kTip) return true;
  return is_valid(setpoint.tip_in_base) && setpoint.tip_speed_m_s > 0.0 && is_finite(setpoint.tip_speed_m_s);
}

}  // namespace liana::serial
