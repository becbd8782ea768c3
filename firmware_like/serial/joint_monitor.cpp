#include "firmware_like/serial/joint_monitor.hpp"

#include <cmath>

#include "firmware_like/math/convert.hpp"
#include "firmware_like/serial/drive_units.hpp"

namespace liana::serial {
namespace {

bool is_outside(const JointParams& joint, double joint_rad) noexcept {
  return joint_rad < joint.low_rad - kRangeMargin_rad || joint_rad > joint.high_rad + kRangeMargin_rad;
}

// The twin of a torque drive catches up by itself slowly (ideal_torque_feedback).
double most_turn_rad(const RobotParams& table, const JointParams& joint) noexcept {
  const double servo_s = table.torque.is_torque_controlled != 0 ? 0.0 : table.servo_time_constant_s;
  return kJumpWindow_rad + joint.rate_rad_s * jump_s(table.tick_s, servo_s);
}

}  // namespace

void read_joint(const RobotParams& table, const DriveFeedback& drive, std::int32_t joint,
                JointMonitorState& state) noexcept {
  const std::size_t i = as_index(joint);
  JointReading& reading = state.reading[i];
  reading.jumped = false;
  if (drive.feedback_age_ticks == 0xFFFF) return;
  const double now_rad = joint_at_counts(table.drive[i], drive.position_counts);
  reading.jumped = reading.heard && std::fabs(now_rad - reading.joint_rad) > most_turn_rad(table, table.joint[i]);
  reading.joint_rad = now_rad;
  reading.heard = true;
}

bool is_plausible(const RobotParams& table, const JointMonitorState& state) noexcept {
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const JointReading& reading = state.reading[i];
    if (!reading.heard || reading.jumped || is_outside(table.joint[i], reading.joint_rad)) return false;
  }
  return true;
}

void watch_joint(const RobotParams& table, WatchScope scope, std::int32_t joint, JointMonitorState& state,
                 Watch& out) noexcept {
  const std::size_t i = as_index(joint);
  const JointReading& reading = state.reading[i];
  if (reading.jumped) out.wrong(FaultNumber::kJointJump, joint, 0);
  const bool outside = scope.powered && is_outside(table.joint[i], reading.joint_rad);
  out.debounced(outside, kRangeDebounceTicks, state.outside_ticks[i], FaultNumber::kJointOutOfRange, joint);
}

}  // namespace liana::serial
