// Field lists of a serial arm in recordings: what it is asked, what leaves a tick, its table. Its joints count as
// thetas.
#pragma once

#include "firmware_like/serial_controller.hpp"
#include "host/storage/recording/visit.hpp"

namespace liana::recording {

inline RecordedCounts counts_of(const serial::RobotParams& table) {
  const auto joints = static_cast<std::uint8_t>(table.joint_count);
  return {joints, joints, 0};
}

template <class A, Like<serial::Wrench> T>
void visit(A& a, T& w) {
  a("force_N", w.force_N);
  a("torque_Nm", w.torque_Nm);
}

template <class A, Like<serial::WristReading> T>
void visit(A& a, T& w) {
  a("on_arm", w.on_arm);
  a("sequence", w.sequence);
  a("status", w.status);
  a("age_ticks", w.age_ticks);
}

template <class A, Like<serial::AdapterReading> T>
void visit(A& a, T& r) {
  a("sequence", r.sequence);
  a("captured", r.captured);
  a("latch", r.latch);
  a("lock", r.lock);
  a("depth_01mm", r.depth_01mm);
  a("age_ticks", r.age_ticks);
}

template <class A, Like<serial::Sensors> T>
void visit(A& a, T& s) {
  a("wrist", s.wrist);
  a("adapter", s.adapter);
}

template <class A, Like<serial::Push> T>
void visit(A& a, T& p) {
  a("number", p.number);
  a("law", p.law);
  a("tares", p.tares);
  a("axis_in_tip", p.axis_in_tip);
  a("force_N", p.force_N);
  a("travel_m", p.travel_m);
  a("aside_m", p.aside_m);
  a("turn_rad", p.turn_rad);
  a("depth_m", p.depth_m);
  a("gains", p.gains);
}

template <class A, Like<serial::InsertStatus> T>
void visit(A& a, T& p) {
  a("number", p.number);
  a("phase", p.phase);
  a("end", p.end);
  a("law", p.law);
  a("wrist", p.wrist);
  a("touched", p.touched);
  a("set_N", p.set_N);
  a("travel_m", p.travel_m);
  a("aside_m", p.aside_m);
  a("felt", p.felt);
  a("given", p.given);
  a("wrist_age_ticks", p.wrist_age_ticks);
  a("adapter_age_ticks", p.adapter_age_ticks);
  a("adapter_sequence", p.adapter_sequence);
  a("captured", p.captured);
  a("latch", p.latch);
  a("lock", p.lock);
  a("depth_01mm", p.depth_01mm);
}

template <class A, Like<serial::Setpoint> T>
void visit(A& a, T& s) {
  a("kind", s.kind);
  a("tip_in_base", s.tip_in_base);
  visit_first(a, "joint_rad", s.joint_rad, counts_of_visitor(a).thetas);
  a("tip_speed_m_s", s.tip_speed_m_s);
  a("push", s.push);
  a("payload_at_tip", s.payload_at_tip);
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
  visit_first(a, "torque_told_Nm", o.torque_told_Nm, joints);
  a("push", o.push);
}

template <class A, Like<serial::DhRow> T>
void visit(A& a, T& d) {
  a("alpha_rad", d.alpha_rad);
  a("a_m", d.a_m);
  a("d_m", d.d_m);
  a("offset_rad", d.offset_rad);
}

template <class A, Like<serial::JointParams> T>
void visit(A& a, T& j) {
  a("dh", j.dh);
  a("low_rad", j.low_rad);
  a("high_rad", j.high_rad);
  a("rate_rad_s", j.rate_rad_s);
  a("accel_rad_s2", j.accel_rad_s2);
}

template <class A, Like<serial::DriveParams> T>
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

template <class A, Like<serial::LinkMass> T>
void visit(A& a, T& m) {
  a("mass_kg", m.mass_kg);
  a("center_m", m.center_m);
  a("inertia_kgm2", m.inertia_kgm2);
}

template <class A, Like<serial::MassTable> T>
void visit(A& a, T& m) {
  a("link", m.link);
}

template <class A, Like<serial::TorqueParams> T>
void visit(A& a, T& t) {
  a("gives_torque", t.is_torque_controlled);
  a("masses", t.masses);
  a("coulomb_Nm", t.coulomb_Nm);
  a("viscous_Nms_per_rad", t.viscous_Nms_per_rad);
  a("position_gain_per_s", t.position_gain_per_s);
  a("most_joint_Nm", t.most_joint_Nm);
  a("most_force_N", t.most_force_N);
  a("most_travel_m", t.most_travel_m);
  a("most_aside_m", t.most_aside_m);
  a("most_turn_rad", t.most_turn_rad);
  a("wrist_still_samples", t.wrist_still_samples);
  a("gain_low", t.gain_low);
  a("gain_high", t.gain_high);
}

template <class A, Like<serial::RobotParams> T>
void visit(A& a, T& r) {
  a("joint_count", r.joint_count);
  a("joint", r.joint);
  a("drive", r.drive);
  a("tip", r.tip);
  a("torque", r.torque);
  a("servo_time_constant_s", r.servo_time_constant_s);
  a("tick_s", r.tick_s);
  a("interval_ticks", r.interval_ticks);
}

}  // namespace liana::recording
