// Field lists of a serial arm in recordings: what it is asked, what leaves a tick, its table. Its joints count as
// thetas.
#pragma once

#include "firmware_like/serial_controller.hpp"
#include "host/record/visit.hpp"

namespace liana::record {

inline RecordedCounts counts_of(const serial::RobotTable& table) {
  const auto joints = static_cast<std::uint8_t>(table.joint_count);
  return {joints, joints, 0};
}

template <class A, Like<serial::Setpoint> T>
void visit(A& a, T& s) {
  a("kind", s.kind);
  a("tip_in_base", s.tip_in_base);
  visit_first(a, "joint_rad", s.joint_rad, counts_of_visitor(a).thetas);
  a("tip_speed_m_s", s.tip_speed_m_s);
}

template <class A, Like<serial::Outputs> T>
void visit(A& a, T& o) {
  const std::size_t joints = counts_of_visitor(a).thetas;
  a("tick", o.tick);
  a("state", o.state);
  a("stop_category", o.stop_category);
  a("limits", o.limits);
  a("at_rest", o.at_rest);
  a("homed", o.homed);
  a("active_sequence", o.active_sequence);
  a("faults", o.faults);
  visit_first(a, "drive", o.drive, counts_of_visitor(a).drives);
  visit_first(a, "joint_command_rad", o.joint_command_rad, joints);
  visit_first(a, "joint_rate_rad_s", o.joint_rate_rad_s, joints);
  visit_first(a, "joint_measured_rad", o.joint_measured_rad, joints);
  visit_first(a, "torque_measured_Nm", o.torque_measured_Nm, joints);
  a("tip_goal", o.tip_goal);
  a("tip_command", o.tip_command);
  a("tip_speed_m_s", o.tip_speed_m_s);
  a("tip_rate_rad_s", o.tip_rate_rad_s);
  a("ik_position_error_m", o.ik_position_error_m);
  a("ik_attitude_error_rad", o.ik_attitude_error_rad);
  a("ik_outcome", o.ik_outcome);
  a("ik_residual", o.ik_residual);
}

template <class A, Like<serial::DhRow> T>
void visit(A& a, T& d) {
  a("alpha_rad", d.alpha_rad);
  a("a_m", d.a_m);
  a("d_m", d.d_m);
  a("offset_rad", d.offset_rad);
}

template <class A, Like<serial::JointTable> T>
void visit(A& a, T& j) {
  a("dh", j.dh);
  a("low_rad", j.low_rad);
  a("high_rad", j.high_rad);
  a("rate_rad_s", j.rate_rad_s);
  a("accel_rad_s2", j.accel_rad_s2);
}

template <class A, Like<serial::DriveTable> T>
void visit(A& a, T& d) {
  a("rad_per_count", d.rad_per_count);
  a("direction", d.direction);
  a("zero_counts", d.zero_counts);
  a("torque_per_permille_Nm", d.torque_per_permille_Nm);
}

template <class A, Like<serial::TipLimits> T>
void visit(A& a, T& t) {
  a("speed_m_s", t.speed_m_s);
  a("accel_m_s2", t.accel_m_s2);
  a("jerk_m_s3", t.jerk_m_s3);
  a("rate_rad_s", t.rate_rad_s);
  a("angular_accel_rad_s2", t.angular_accel_rad_s2);
  a("angular_jerk_rad_s3", t.angular_jerk_rad_s3);
}

template <class A, Like<serial::RobotTable> T>
void visit(A& a, T& r) {
  a("joint_count", r.joint_count);
  a("joint", r.joint);
  a("drive", r.drive);
  a("tip", r.tip);
  a("servo_time_constant_s", r.servo_time_constant_s);
  a("tick_s", r.tick_s);
  a("interval_ticks", r.interval_ticks);
}

}  // namespace liana::record
