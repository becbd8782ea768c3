#include "firmware_like/serial/serial_arm.hpp"

#include "firmware_like/math/convert.hpp"

namespace liana::serial {

SerialArm::SerialArm(const RobotParams& table) noexcept
    : table_(table), dynamics_(table, table.torque.masses), friction_(declared_friction(table)) {
  stand();
}

JointVector SerialArm::measured_rad() const noexcept {
  JointVector joint{};
  for (std::size_t i = 0; i < table_.joints(); ++i) joint[i] = joints_.reading[i].joint_rad;
  return joint;
}

void SerialArm::read(const DriveFeedbacks& drives, const Sensors& sensors) noexcept {
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
  read_wrist(sensors.wrist, table_.torque.wrist_still_samples, wrist_);
  read_adapter(sensors.adapter, adapter_);
}

void SerialArm::watch_drive(WatchScope scope, bool, std::int32_t drive, Watch& out) noexcept {
  watch_joint(table_, scope, drive, joints_, out);
}

// What ended a push, named in the tick after it: until then the arm gives way already.
void SerialArm::watch(WatchScope, std::uint64_t tick, FaultList& faults) noexcept {
  if (push_.phase != InsertPhase::kYielding || push_.phase_ticks != 0) return;
  if (push_.end == InsertResult::kSensorLost) {
    latch(faults, {FaultNumber::kWristSensorLost, -1, static_cast<std::uint16_t>(push_.lost), tick});
  }
  if (push_.end == InsertResult::kOverload) {
    const std::int32_t size = to_counts(push_.overload).value;
    latch(faults, {FaultNumber::kPushOverload, push_.overload_joint, narrow<std::uint16_t>(size), tick});
  }
}

void SerialArm::take(const Setpoint& setpoint) noexcept {
  accept_setpoint(table_, setpoint, motion_);
  if (is_motion(setpoint.kind)) payload_ = setpoint.payload_at_tip;
  if (is_force(setpoint.kind)) {
    accept_force(setpoint, push_);
  } else {
    push_.phase = InsertPhase::kNone;
  }
}

void SerialArm::stand() noexcept {
  reset_motion(table_, measured_rad(), motion_);
  push_.phase = InsertPhase::kNone;
  told_ = TorqueTold{};
}

ArmStatus SerialArm::status() const noexcept {
  const bool homed = homing_ticks_ >= kHomingTicks;
  const bool pushes = push_.phase != InsertPhase::kNone && push_.phase != InsertPhase::kYielding;
  return {homed, !pushes && at_rest(table_, motion_), homed};  // nothing to prepare
}

// Forces say where the joints go; the target goes with them.
ForceMotion SerialArm::give_way(bool allowed) noexcept {
  const JointVector measured = measured_rad();
  const InsertInputs in{measured, torque_measured_Nm_, motion_.limiter.rate_rad_s, adapter_, allowed};
  const ForceMotion wanted = advance_force(table_, in, wrist_, push_);
  follow_along(table_, wanted, in.measured_rad, motion_.limiter);
  motion_.ik_rad = motion_.limiter.joint_rad;
  motion_.arm = forward_kinematics(table_, motion_.limiter.joint_rad);
  motion_.filter.pose = motion_.arm.tip_in_base;
  motion_.ik = report_ik(table_, motion_.filter.pose, motion_.arm.tip_in_base);
  motion_.limits = 0;
  return wanted;
}

// Planned motion: what moving the links and what they carry takes, and what friction does.
ForceMotion SerialArm::lead() noexcept {
  dynamics_.set_payload(payload_);
  ForceMotion wanted = planned_motion(table_, dynamics_, motion_.limiter, told_);
  find_friction(table_, wanted.rate_rad_s, wanted.torque_Nm, torque_measured_Nm_, friction_);
  const JointVector friction = friction_Nm(table_, friction_, wanted.rate_rad_s);
  for (std::size_t i = 0; i < table_.joints(); ++i) wanted.torque_Nm[i] += friction[i];
  return wanted;
}

std::uint32_t SerialArm::advance(bool allowed) noexcept {
  ForceMotion wanted;
  if (is_torque_controlled(table_) && is_force(motion_.to.kind)) {
    wanted = give_way(allowed && !motion_.braking);
  } else {
    advance_motion(table_, allowed, motion_);
    if (is_torque_controlled(table_)) wanted = lead();
  }
  if (is_torque_controlled(table_)) tell_torque(table_, wanted, measured_rad(), motion_.limiter, told_);
  return motion_.limits;
}

std::uint32_t SerialArm::propose(const Orders& orders, const DriveCommands&, bool, DriveProposals& out) noexcept {
  if (!orders.live_targets) return 0;
  for (std::size_t i = 0; i < table_.joints(); ++i) {
    const DriveParams& drive = table_.drive[i];
    out[i].target_counts = counts_at_joint(drive, motion_.limiter.joint_rad[i]);
    if (!is_torque_controlled(table_)) continue;
    out[i].mode = DriveMode::kCyclicTorque;
    out[i].torque_permille = drive.direction * told_.torque_Nm[i] / drive.torque_per_permille_Nm;
    out[i].rate_counts_s = drive.direction * told_.rate_rad_s[i] / drive.rad_per_count;
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
  out.torque_told_Nm = told_.torque_Nm;
  out.push = push_report(push_, wrist_, adapter_);
}

}  // namespace liana::serial
