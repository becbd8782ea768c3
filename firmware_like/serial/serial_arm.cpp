#include "firmware_like/serial/serial_arm.hpp"

#include "firmware_like/math/convert.hpp"

namespace liana::serial {

SerialArm::SerialArm(const RobotTable& table) noexcept : table_(table) { stand(); }

JointVector SerialArm::measured_rad() const noexcept {
  JointVector joint{};
  for (std::size_t i = 0; i < table_.joints(); ++i) joint[i] = joints_.reading[i].joint_rad;
  return joint;
}

void SerialArm::read(const DriveFeedbacks& drives, const NoSensors&) noexcept {
  bool all_fresh = true;
  for (std::int32_t drive = 0; drive < table_.drive_count(); ++drive) {
    const std::size_t i = as_index(drive);
    read_joint(table_, drives[i], drive, joints_);
    torque_measured_Nm_[i] =
        table_.drive[i].direction * table_.drive[i].torque_per_permille_Nm * drives[i].torque_permille;
    if (drives[i].feedback_age_ticks > kFeedbackAgeTicks) all_fresh = false;
  }
  if (!all_fresh || !is_plausible(table_, joints_)) {
    homing_ticks_ = 0;
  } else if (homing_ticks_ < kHomingTicks) {
    ++homing_ticks_;
  }
}

void SerialArm::watch_drive(WatchScope scope, bool, std::int32_t drive, Watch& out) noexcept {
  watch_joint(table_, scope, drive, joints_, out);
}

ArmStatus SerialArm::status() const noexcept {
  const bool homed = homing_ticks_ >= kHomingTicks;
  return {homed, at_rest(table_, motion_), homed};  // nothing to prepare
}

std::uint32_t SerialArm::advance(bool allowed) noexcept {
  advance_motion(table_, allowed, motion_);
  return motion_.limits;
}

std::uint32_t SerialArm::propose(const Orders& orders, const DriveCommands&, bool, DriveProposals& out) noexcept {
  if (!orders.live_targets) return 0;
  for (std::size_t i = 0; i < table_.joints(); ++i) {
    out[i].target_counts = counts_at_joint(table_.drive[i], motion_.limiter.joint_rad[i]);
  }
  return 0;
}

void SerialArm::report(Report& out) const noexcept {
  out.joint_command_rad = motion_.limiter.joint_rad;
  out.joint_rate_rad_s = motion_.limiter.rate_rad_s;
  out.joint_measured_rad = measured_rad();
  out.torque_measured_Nm = torque_measured_Nm_;
  out.tip_goal = motion_.filter.pose;
  out.tip_command = motion_.arm.tip_in_base;
  const Twist tip = tip_twist(table_, motion_.arm.tip_jacobian, motion_.limiter.rate_rad_s);
  out.tip_speed_m_s = norm(tip.linear_m_s);
  out.tip_rate_rad_s = norm(tip.angular_rad_s);
  out.ik_position_error_m = motion_.ik.position_error_m;
  out.ik_attitude_error_rad = motion_.ik.attitude_error_rad;
  out.ik_outcome = motion_.ik.outcome;
  out.ik_residual = motion_.ik.residual;
}

}  // namespace liana::serial
