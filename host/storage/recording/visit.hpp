// The field lists of everything that is recorded, in recorded order. One list serves writing, reading and naming.
#pragma once

#include <algorithm>
#include <concepts>
#include <type_traits>

#include "firmware_like/cable_controller.hpp"

namespace liana::recording {

// T or const T: writers visit constants, readers visit variables.
template <class T, class Plain>
concept Like = std::same_as<std::remove_const_t<T>, Plain>;

// How many of each a robot has: what is written of arrays with more places. As made: all places.
struct RecordedCounts {
  std::uint8_t drives = kMaxDrives, thetas = cable::kMaxTheta, segments = cable::kMaxSegments;
};

inline RecordedCounts counts_of(const cable::RobotParams& table) {
  return {static_cast<std::uint8_t>(table.drive_count()), static_cast<std::uint8_t>(table.theta_count()),
          static_cast<std::uint8_t>(table.segment_count)};
}

// The counts that a visitor goes by; all places when it names none.
template <class A>
RecordedCounts counts_of_visitor(const A& a) {
  if constexpr (requires { a.counts(); }) return a.counts();
  return {};
}

// Visits the first `count` of an array; visitors without counts see the array.
template <class A, class T>
void visit_first(A& a, const char* name, T& values, std::size_t count) {
  if constexpr (requires { a.first(name, values, count); }) {
    a.first(name, values, std::min(count, values.size()));
  } else {
    a(name, values);
  }
}

// A telecommand's fields, in the open: Telecommand itself can be made only by Release and RecordingDecoder.
template <class Setpoint>
struct TelecommandFields {
  std::uint64_t sequence = 0, first_tick = 0, expiry_tick = 0;
  std::uint32_t owner = 0;
  Setpoint setpoint{};
};

template <class A, Like<Pose> T>
void visit(A& a, T& p) {
  a("position_m", p.position_m);
  a("quaternion", p.quaternion);
}

template <class A, Like<cable::NodeTarget> T>
void visit(A& a, T& n) {
  a("node", n.node);
  a("position_m", n.position_m);
  a("weight", n.weight);
  a("threshold_m", n.threshold_m);
}

template <class A, Like<cable::KeepClear> T>
void visit(A& a, T& k) {
  a("centre_m", k.centre_m);
  a("distance_m", k.distance_m);
  a("weight", k.weight);
}

template <class A, Like<cable::Setpoint> T>
void visit(A& a, T& s) {
  a("kind", s.kind);
  a("tip_in_base", s.tip_in_base);
  a("held_mask", s.held_mask);
  visit_first(a, "held_rad", s.held_rad, counts_of_visitor(a).thetas);
  a("node", s.node);
  a("clear", s.clear);
  visit_first(a, "joint_rad", s.joint_rad, counts_of_visitor(a).thetas);
  a("tip_speed_m_s", s.tip_speed_m_s);
  a("dither_share", s.dither_share);
}

template <class A, class Fields>
void visit_telecommand_fields(A& a, Fields& t) {
  a("sequence", t.sequence);
  a("first_tick", t.first_tick);
  a("expiry_tick", t.expiry_tick);
  a("owner", t.owner);
  a("setpoint", t.setpoint);
}

template <class A, class Setpoint>
void visit(A& a, TelecommandFields<Setpoint>& t) {
  visit_telecommand_fields(a, t);
}
template <class A, class Setpoint>
void visit(A& a, const TelecommandFields<Setpoint>& t) {
  visit_telecommand_fields(a, t);
}

template <class A, Like<DriveFeedback> T>
void visit(A& a, T& d) {
  a("statusword", d.statusword);
  a("torque_permille", d.torque_permille);
  a("position_counts", d.position_counts);
  a("rate_counts_s", d.rate_counts_s);
  a("feedback_age_ticks", d.feedback_age_ticks);
  a("heartbeat_age_ticks", d.heartbeat_age_ticks);
  a("emergency_code", d.emergency_code);
  a("operational", d.operational);
}

// All of Inputs but the telecommand, which follows as TelecommandFields; the arm's own sensors last.
template <class A, class T>
requires std::derived_from<T, CycleInputs>
void visit(A& a, T& i) {
  a("tick", i.tick);
  a("lost_ticks", i.lost_ticks);
  a("lost_bus_mask", i.lost_bus_mask);
  a("twice_mask", i.twice_mask);
  a("request", i.request);
  visit_first(a, "drive", i.drive, counts_of_visitor(a).drives);
  if constexpr (!std::same_as<std::remove_cvref_t<decltype(i.sensors)>, NoSensors>) a("sensors", i.sensors);
}

template <class A, Like<Fault> T>
void visit(A& a, T& f) {
  a("number", f.number);
  a("index", f.index);
  a("detail", f.detail);
  a("tick", f.tick);
}

template <class A, Like<FaultList> T>
void visit(A& a, T& l) {
  a("fault", l.fault);
  a("count", l.count);
  a("dropped", l.dropped);
  a("category", l.category);
  a("immediate", l.immediate);
}

template <class A, Like<DriveCommand> T>
void visit(A& a, T& d) {
  a("controlword", d.controlword);
  a("target_counts", d.target_counts);
  a("torque_permille", d.torque_permille);
  a("rate_counts_s", d.rate_counts_s);
}

template <class A, Like<cable::FrictionStatus> T>
void visit(A& a, T& f) {
  a("mu", f.mu);
  a("sd", f.sd);
  a("planned_mu", f.planned_mu);
  a("not_as_declared", f.not_as_declared);
}

template <class A, Like<cable::ContactStatus> T>
void visit(A& a, T& c) {
  a("force_N", c.force_N);
  a("sd_N", c.sd_N);
  a("seen", c.seen);
  a("state", c.state);
  a("on_body", c.on_body);
  a("segment", c.segment);
  a("torque_Nm", c.torque_Nm);
}

template <class A, Like<cable::Outputs> T>
void visit(A& a, T& o) {
  a("tick", o.tick);
  a("state", o.state);
  a("stop_category", o.stop_category);
  a("limits", o.limits);
  a("held_mask", o.held_mask);
  a("held_at_target", o.held_at_target);
  a("at_rest", o.at_rest);
  a("homed", o.homed);
  a("active_sequence", o.active_sequence);
  a("faults", o.faults);
  visit_first(a, "drive", o.drive, counts_of_visitor(a).drives);
  visit_first(a, "theta_command_rad", o.theta_command_rad, counts_of_visitor(a).thetas);
  visit_first(a, "theta_rate_rad_s", o.theta_rate_rad_s, counts_of_visitor(a).thetas);
  visit_first(a, "theta_measured_rad", o.theta_measured_rad, counts_of_visitor(a).thetas);
  a("tip_goal", o.tip_goal);
  a("tip_command", o.tip_command);
  a("tip_speed_m_s", o.tip_speed_m_s);
  a("tip_rate_rad_s", o.tip_rate_rad_s);
  visit_first(a, "node_command_m", o.node_command_m, counts_of_visitor(a).segments);
  a("speed_share", o.speed_share);
  a("turn_share", o.turn_share);
  visit_first(a, "load_Nm", o.load_Nm, counts_of_visitor(a).thetas);
  visit_first(a, "tension_plan_N", o.tension_plan_N, counts_of_visitor(a).drives);
  visit_first(a, "tension_measured_N", o.tension_measured_N, counts_of_visitor(a).drives);
  visit_first(a, "payout_command_m", o.payout_command_m, counts_of_visitor(a).drives);
  a("friction", o.friction);
  a("contact", o.contact);
  a("ik_position_error_m", o.ik_position_error_m);
  a("ik_attitude_error_rad", o.ik_attitude_error_rad);
  a("ik_outcome", o.ik_outcome);
  a("ik_residual", o.ik_residual);
}

template <class A, Like<cable::SegmentParams> T>
void visit(A& a, T& s) {
  a("modules", s.modules);
  a("cables", s.cables);
  a("module_length_m", s.module_length_m);
  a("theta_limit_rad", s.theta_limit_rad);
  a("module_mass_kg", s.module_mass_kg);
  a("cable_phase_rad", s.cable_phase_rad);
}

template <class A, Like<cable::TensionLimits> T>
void visit(A& a, T& t) {
  a("plan_N", t.plan_N);
  a("floor_motor_N", t.floor_motor_N);
  a("floor_anywhere_N", t.floor_anywhere_N);
  a("ceiling_free_N", t.ceiling_free_N);
  a("alarm_N", t.alarm_N);
  a("hard_limit_N", t.hard_limit_N);
}

template <class A, Like<cable::CableMonitorParams> T>
void visit(A& a, T& w) {
  a("jump_N", w.jump_N);
  a("contradiction_m", w.contradiction_m);
}

template <class A, Like<cable::TorqueZeroTable> T>
void visit(A& a, T& t) {
  a("bias_N", t.bias_N);
  a("drift_N_h", t.drift_N_h);
}

template <class A, Like<cable::MotionLimits> T>
void visit(A& a, T& m) {
  a("theta_rate_rad_s", m.theta_rate_rad_s);
  a("theta_accel_rad_s2", m.theta_accel_rad_s2);
  a("tip_speed_m_s", m.tip_speed_m_s);
  a("tip_speed_slit_m_s", m.tip_speed_slit_m_s);
  a("tip_accel_m_s2", m.tip_accel_m_s2);
  a("tip_jerk_m_s3", m.tip_jerk_m_s3);
  a("tip_rate_rad_s", m.tip_rate_rad_s);
  a("tip_angular_accel_rad_s2", m.tip_angular_accel_rad_s2);
  a("tip_angular_jerk_rad_s3", m.tip_angular_jerk_rad_s3);
  a("cable_speed_m_s", m.cable_speed_m_s);
  a("tip_lag_s", m.tip_lag_s);
}

template <class A, Like<cable::DriveParams> T>
void visit(A& a, T& d) {
  a("metres_per_count", d.metres_per_count);
  a("direction", d.direction);
  a("zero_counts", d.zero_counts);
  a("newtons_per_permille", d.newtons_per_permille);
}

template <class A, Like<cable::RobotParams> T>
void visit(A& a, T& r) {
  a("segment_count", r.segment_count);
  a("segment", r.segment);
  a("hole_radius_m", r.hole_radius_m);
  a("face_offset_m", r.face_offset_m);
  a("cable_EA_N", r.cable_EA_N);
  a("lead_m", r.lead_m);
  a("friction_mu", r.friction_mu);
  a("servo_time_constant_s", r.servo_time_constant_s);
  a("tick_s", r.tick_s);
  a("interval_ticks", r.interval_ticks);
  a("tension", r.tension);
  a("cable_watch", r.cable_monitor);
  a("torque_zero", r.torque_zero);
  a("limits", r.limits);
  a("drive", r.drive);
}

}  // namespace liana::recording
