// Field lists of what a serial arm keeps between ticks, for images of a Controller.
#pragma once

#include "host/storage/recording/visit_core_state.hpp"
#include "host/storage/recording/visit_serial.hpp"

namespace liana::recording {

template <class A, Like<serial::JointReading> T>
void visit(A& a, T& s) {
  a("joint_rad", s.joint_rad);
  a("heard", s.heard);
  a("jumped", s.jumped);
}

template <class A, Like<serial::JointMonitorState> T>
void visit(A& a, T& s) {
  a("reading", s.reading);
  a("outside_ticks", s.outside_ticks);
}

template <class A, Like<serial::LimiterState> T>
void visit(A& a, T& s) {
  a("joint_rad", s.joint_rad);
  a("rate_rad_s", s.rate_rad_s);
  a("reference_rad", s.reference_rad);
  a("limits", s.limits);
}

template <class A, Like<serial::Jacobian> T>
void visit(A& a, T& s) {
  a("linear", s.linear);
  a("angular", s.angular);
}

template <class A, Like<serial::ArmKinematics> T>
void visit(A& a, T& s) {
  a("point_in_base", s.point_in_base);
  a("tip_in_base", s.tip_in_base);
  a("tip_jacobian", s.tip_jacobian);
}

template <class A, Like<serial::IkResult> T>
void visit(A& a, T& s) {
  a("residual", s.residual);
  a("position_error_m", s.position_error_m);
  a("attitude_error_rad", s.attitude_error_rad);
  a("outcome", s.outcome);
  a("limit_mask", s.limit_mask);
}

template <class A, Like<serial::MotionState> T>
void visit(A& a, T& s) {
  a("from", s.from);
  a("to", s.to);
  a("turn_rad", s.turn_rad);
  a("interval_tick", s.interval_tick);
  a("braking", s.braking);
  a("filter", s.filter);
  a("ik_rad", s.ik_rad);
  a("limiter", s.limiter);
  a("arm", s.arm);
  a("ik", s.ik);
  a("limits", s.limits);
}

template <class A, Like<serial::WristState> T>
void visit(A& a, T& s) {
  a("felt", s.felt);
  a("tare", s.tare);
  a("said", s.said);
  a("sequence", s.sequence);
  a("age_ticks", s.age_ticks);
  a("same_samples", s.same_samples);
}

template <class A, Like<serial::AdapterState> T>
void visit(A& a, T& s) {
  a("last", s.last);
  a("is_new", s.is_new);
  a("repeated", s.repeated);
  a("age_ticks", s.age_ticks);
}

template <class A, Like<serial::Twist> T>
void visit(A& a, T& s) {
  a("linear_m_s", s.linear_m_s);
  a("angular_rad_s", s.angular_rad_s);
}

template <class A, Like<serial::InsertState> T>
void visit(A& a, T& s) {
  a("order", s.order);
  a("phase", s.phase);
  a("end", s.end);
  a("phase_ticks", s.phase_ticks);
  a("relieved_ticks", s.relieved_ticks);
  a("start", s.start);
  a("velocity", s.velocity);
  a("tare_sum", s.tare_sum);
  a("forward", s.forward);
  a("approach_m", s.approach_m);
  a("touch_ticks", s.touch_ticks);
  a("resist_ticks", s.resist_ticks);
  a("adapter_spoke", s.adapter_spoke);
  a("overload_ticks", s.overload_ticks);
  a("lost", s.lost);
  a("overload_joint", s.overload_joint);
  a("overload", s.overload);
  a("given", s.given);
  a("set_N", s.set_N);
  a("travel_m", s.travel_m);
  a("aside_m", s.aside_m);
}

template <class A, Like<serial::JointFriction> T>
void visit(A& a, T& f) {
  a("coulomb_Nm", f.coulomb_Nm);
  a("sum_Nm", f.sum_Nm);
  a("rate_rad_s", f.rate_rad_s);
  a("ticks", f.ticks);
}

template <class A, Like<serial::TorqueTold> T>
void visit(A& a, T& s) {
  a("rate_rad_s", s.rate_rad_s);
  a("torque_Nm", s.torque_Nm);
  a("planned_rad_s", s.planned_rad_s);
}

}  // namespace liana::recording
