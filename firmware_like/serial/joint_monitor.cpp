#include "firmware_like/serial/joint_monitor.hpp"

#include <cmath>

#include "firmware_like/math/convert.hpp"
#include "firmware_like/serial/drive_units.hpp"

namespace liana::serial {
namespace {

bool is_outside(const JointParams& joint, double joint_rad) noexcept {
  return joint_rad < joint.low_rad - kRangeMargin_rad || joint_rad > joint.high_rad + kRangeMargin_rad;
}

// A message may be missing for kFeedbackAgeTicks without a fault, and the joint turns on meanwhile.
double most_turn_rad(const RobotParams& table, const JointParams& joint) noexcept {
  return kJumpWindow_rad + kJumpRateShare * joint.rate_rad_s * table.tick_s * (1.0 + kFeedbackAgeTicks);
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
