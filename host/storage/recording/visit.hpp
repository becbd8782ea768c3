// What is recorded of the core, in recorded order; the same serves writing, reading and naming. What every tick records
// has field lists: their names are the format's. State and tables are recorded by their members. Joints of a serial arm
// count as thetas.
#pragma once

#include <algorithm>
#include <concepts>
#include <type_traits>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"
#include "host/storage/recording/members.hpp"

namespace liana::recording {

// T or const T: writers visit constants, readers visit variables.
template <class T, class Plain>
concept Like = std::same_as<std::remove_const_t<T>, Plain>;

// How many of each a robot has: what is written of arrays with more places. As made: all places.
struct RecordedCounts {
  std::uint8_t drives = kMaxDrives, thetas = cable::kMaxTheta, segments = cable::kMaxSegments;
  std::uint8_t load_cells = kMaxDrives;  // cables up to the last one with a load cell
};

inline RecordedCounts counts_of(const cable::RobotParams& table) {
  std::uint8_t cells = 0;
  for (std::int32_t c = 0; c < table.cable_count(); ++c)
    if (cable::has_load_cell(table, as_index(c))) cells = static_cast<std::uint8_t>(c + 1);
  return {static_cast<std::uint8_t>(table.drive_count()), static_cast<std::uint8_t>(table.theta_count()),
          static_cast<std::uint8_t>(table.segment_count), cells};
}

inline RecordedCounts counts_of(const serial::RobotParams& table) {
  const auto joints = static_cast<std::uint8_t>(table.joint_count);
  return {joints, joints, 0, 0};
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

template <class Setpoint>
TelecommandFields<Setpoint> fields_of(const Telecommand<Setpoint>& t) {
  return {t.sequence(), t.first_tick(), t.expiry_tick(), t.owner(), t.setpoint()};
}
// What was released then (serialise.cpp).
template <class Setpoint>
Telecommand<Setpoint> telecommand_of(const TelecommandFields<Setpoint>& fields);

template <class A, Like<Pose> T>
void visit_listed(A& a, T& p) {
  a("position_m", p.position_m);
  a("quaternion", p.quaternion);
}

template <class A, Like<cable::NodeTarget> T>
void visit_listed(A& a, T& n) {
  a("node", n.node);
  a("position_m", n.position_m);
  a("weight", n.weight);
  a("threshold_m", n.threshold_m);
}

template <class A, Like<cable::KeepClear> T>
void visit_listed(A& a, T& k) {
  a("centre_m", k.centre_m);
  a("distance_m", k.distance_m);
  a("weight", k.weight);
}

template <class A, Like<cable::Setpoint> T>
void visit_listed(A& a, T& s) {
  a("kind", s.kind);
  a("tip_in_base", s.tip_in_base);
  a("held_mask", s.held_mask);
  visit_first(a, "held_rad", s.held_rad, counts_of_visitor(a).thetas);
  a("node", s.node);
  a("clear", s.clear);
  visit_first(a, "joint_rad", s.joint_rad, counts_of_visitor(a).thetas);
  a("tip_speed_m_s", s.tip_speed_m_s);
  a("payload", s.payload);
  a("dither_share", s.dither_share);
}

template <class A, class T>
requires requires(const T& t) {
  []<class Setpoint>(const TelecommandFields<Setpoint>&) {}(t);
}
void visit_listed(A& a, T& t) {
  a("sequence", t.sequence);
  a("first_tick", t.first_tick);
  a("expiry_tick", t.expiry_tick);
  a("owner", t.owner);
  a("setpoint", t.setpoint);
}

template <class A, Like<DriveFeedback> T>
void visit_listed(A& a, T& d) {
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
void visit_listed(A& a, T& i) {
  a("tick", i.tick);
  a("lost_ticks", i.lost_ticks);
  a("lost_bus_mask", i.lost_bus_mask);
  a("twice_mask", i.twice_mask);
  a("request", i.request);
  visit_first(a, "drive", i.drive, counts_of_visitor(a).drives);
  a("sensors", i.sensors);
}

template <class A, Like<Fault> T>
void visit_listed(A& a, T& f) {
  a("number", f.number);
  a("index", f.index);
  a("detail", f.detail);
  a("tick", f.tick);
}

template <class A, Like<FaultList> T>
void visit_listed(A& a, T& l) {
  a("fault", l.fault);
  a("count", l.count);
  a("dropped", l.dropped);
  a("category", l.category);
  a("immediate", l.immediate);
}

template <class A, Like<DriveCommand> T>
void visit_listed(A& a, T& d) {
  a("controlword", d.controlword);
  a("target_counts", d.target_counts);
  a("torque_permille", d.torque_permille);
  a("rate_counts_s", d.rate_counts_s);
}

template <class A, Like<cable::FrictionStatus> T>
void visit_listed(A& a, T& f) {
  a("mu", f.mu);
  a("sd", f.sd);
  a("planned_mu", f.planned_mu);
  a("not_as_declared", f.not_as_declared);
}

template <class A, Like<cable::ContactStatus> T>
void visit_listed(A& a, T& c) {
  a("force_N", c.force_N);
  a("sd_N", c.sd_N);
  a("seen", c.seen);
  a("state", c.state);
  a("on_body", c.on_body);
  a("segment", c.segment);
  a("torque_Nm", c.torque_Nm);
}

template <class A, Like<cable::Outputs> T>
void visit_listed(A& a, T& o) {
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
  a("lost_share", o.lost_share);
  visit_first(a, "load_Nm", o.load_Nm, counts_of_visitor(a).thetas);
  visit_first(a, "tension_plan_N", o.tension_plan_N, counts_of_visitor(a).drives);
  visit_first(a, "tension_measured_N", o.tension_measured_N, counts_of_visitor(a).drives);
  if (counts_of_visitor(a).load_cells > 0) a("load_cells", o.load_cells);
  visit_first(a, "payout_command_m", o.payout_command_m, counts_of_visitor(a).drives);
  a("friction", o.friction);
  a("contact", o.contact);
  a("ik_position_error_m", o.ik_position_error_m);
  a("ik_attitude_error_rad", o.ik_attitude_error_rad);
  a("ik_outcome", o.ik_outcome);
  a("ik_residual", o.ik_residual);
}

template <class A, Like<cable::LoadCells> T>
void visit_listed(A& a, T& c) {
  visit_first(a, "steps", c.steps, counts_of_visitor(a).load_cells);
  visit_first(a, "age_ticks", c.age_ticks, counts_of_visitor(a).load_cells);
}

template <class A, Like<serial::Wrench> T>
void visit_listed(A& a, T& w) {
  a("force_N", w.force_N);
  a("torque_Nm", w.torque_Nm);
}

template <class A, Like<serial::WristReading> T>
void visit_listed(A& a, T& w) {
  a("on_arm", w.on_arm);
  a("sequence", w.sequence);
  a("status", w.status);
  a("age_ticks", w.age_ticks);
}

template <class A, Like<serial::AdapterReading> T>
void visit_listed(A& a, T& r) {
  a("sequence", r.sequence);
  a("captured", r.captured);
  a("latch", r.latch);
  a("lock", r.lock);
  a("depth_01mm", r.depth_01mm);
  a("age_ticks", r.age_ticks);
}

template <class A, Like<serial::Sensors> T>
void visit_listed(A& a, T& s) {
  a("wrist", s.wrist);
  a("adapter", s.adapter);
}

template <class A, Like<serial::Push> T>
void visit_listed(A& a, T& p) {
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
void visit_listed(A& a, T& p) {
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
void visit_listed(A& a, T& s) {
  a("kind", s.kind);
  a("tip_in_base", s.tip_in_base);
  visit_first(a, "joint_rad", s.joint_rad, counts_of_visitor(a).thetas);
  a("tip_speed_m_s", s.tip_speed_m_s);
  a("push", s.push);
  a("payload_at_tip", s.payload_at_tip);
}

template <class A, Like<serial::Outputs> T>
void visit_listed(A& a, T& o) {
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

// A telecommand in a snapshot is in the open, too; what is read back is what was released then.
template <class A, class Setpoint>
void visit_listed(A& a, const Telecommand<Setpoint>& t) {
  const auto fields = fields_of(t);
  visit_listed(a, fields);
}
template <class A, class Setpoint>
void visit_listed(A& a, Telecommand<Setpoint>& t) {
  TelecommandFields<Setpoint> fields;
  visit_listed(a, fields);
  t = telecommand_of(fields);
}

// Visits what has a list above by that, an arm and a Controller by their own, all else by its members.
template <class A, class T>
void visit(A& a, T& value) {
  if constexpr (requires { visit_listed(a, value); }) {
    visit_listed(a, value);
  } else if constexpr (requires { value.visit_state(a); }) {
    value.visit_state(a);
  } else {
    visit_members(a, value);
  }
}

}  // namespace liana::recording
