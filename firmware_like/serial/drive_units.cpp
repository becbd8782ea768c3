#include "firmware_like/serial/drive_units.hpp"

#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/serial/torque_drive.hpp"

namespace liana::serial {
namespace {

constexpr std::int64_t kRoundingCounts = 1;  // half a count at either end of a step

DriveLimits limits_of(const RobotParams& table, std::size_t i) noexcept {
  const JointParams& joint = table.joint[i];
  const double low = counts_at_joint(table.drive[i], joint.low_rad - kRangeMargin_rad);
  const double high = counts_at_joint(table.drive[i], joint.high_rad + kRangeMargin_rad);
  const double step_rad = joint.rate_rad_s * table.tick_s * kTargetSpeedMargin;
  DriveLimits limits{};
  limits.min_counts = smaller(low, high);  // counts may grow or fall with the joint angle
  limits.max_counts = larger(low, high);
  limits.step_counts = to_counts(step_rad / table.drive[i].rad_per_count).value + kRoundingCounts;
  limits.min_permille = -kRatedPermille;
  limits.max_permille = kRatedPermille;
  if (table.torque.is_torque_controlled == 0) return limits;
  limits.mode = DriveMode::kCyclicTorque;
  const double per_count = 1.0 / table.drive[i].rad_per_count;
  limits.max_rate_counts_s = kTargetSpeedMargin * joint.rate_rad_s * per_count;
  limits.rate_step_counts_s =
      kTargetSpeedMargin * kRateChangeShare * joint.accel_rad_s2 * table.tick_s * per_count + kRoundingCounts;
  limits.torque_step_permille = kTargetSpeedMargin * kRatedPermille * table.tick_s / kTorqueRamp_s + kRoundingCounts;
  return limits;
}

}  // namespace

GateLimits make_gate_limits(const RobotParams& table) noexcept {
  GateLimits limits{};
  limits.drive_count = table.drive_count();
  for (std::size_t i = 0; i < table.joints(); ++i) limits.drive[i] = limits_of(table, i);
  return limits;
}

LinkLimits make_link_limits(const RobotParams& table) noexcept {
  LinkLimits limits{};
  limits.drive_count = table.drive_count();
  limits.heartbeat_age_ticks = heartbeat_age_ticks(table.tick_s);
  limits.patience = patience(table.tick_s);
  const double delay_s = table.servo_time_constant_s + kFollowingDeadTicks * table.tick_s;
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const double loop_rad = table.torque.is_torque_controlled != 0 ? kTorqueFollowingWindow_rad : kFollowingWindow_rad;
    const double window_rad = loop_rad + kTargetSpeedMargin * table.joint[i].rate_rad_s * delay_s;
    limits.following_counts[i] = to_counts(window_rad / table.drive[i].rad_per_count).value;
  }
  return limits;
}

}  // namespace liana::serial
