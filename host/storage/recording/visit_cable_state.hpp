// Field lists of what a cable arm keeps between ticks, for images of its Controller.
#pragma once

#include "host/storage/recording/visit_core_state.hpp"

namespace liana::recording {

template <class A, Like<cable::EstimatorState> T>
void visit(A& a, T& s) {
  a("theta_rad", s.theta_rad);
  a("tension_N", s.tension_N);
  a("residual_m", s.residual_m);
  a("largest_step_rad", s.largest_step_rad);
  a("primed", s.primed);
}

template <class A, Like<cable::TensionMonitorState> T>
void visit(A& a, T& s) {
  a("slack_ticks", s.slack_ticks);
  a("alarm_ticks", s.alarm_ticks);
  a("overload_ticks", s.overload_ticks);
}

template <class A, Like<cable::CableMonitorState> T>
void visit(A& a, T& s) {
  a("watching", s.watching);
  a("newest", s.newest);
  a("level_N", s.level_N);
  a("residual_m", s.residual_m);
  a("segment", s.segment);
  a("cable", s.cable);
  a("contradicts_ticks", s.contradicts_ticks);
  a("suspect", s.suspect);
  a("suspect_ticks", s.suspect_ticks);
  a("suspect_rose", s.suspect_rose);
  a("suspect_from_N", s.suspect_from_N);
  a("reversals", s.reversals);
}

template <class A, Like<cable::FrictionEstimatorState> T>
void visit(A& a, T& s) {
  a("mu", s.mu);
  a("variance", s.variance);
  a("axis", s.axis);
  a("flagged", s.flagged);
}

template <class A, Like<cable::BodyInertiaState> T>
void visit(A& a, T& s) {
  a("begun", s.begun);
  a("slow_rad", s.slow_rad);
  a("slow_rad_s", s.slow_rad_s);
  a("accel_rad_s2", s.accel_rad_s2);
  a("slow_N", s.slow_N);
  a("tension_N", s.tension_N);
}

template <class A, Like<cable::TorqueBalance> T>
void visit(A& a, T& s) {
  a("whole", s.whole);
  a("slip", s.slip);
  a("per_mu_Nm", s.per_mu_Nm);
  a("torque_Nm", s.torque_Nm);
  a("variance_Nm2", s.variance_Nm2);
  a("pull_Nm", s.pull_Nm);
  a("own", s.own);
  a("shared", s.shared);
  a("rate_rad_s", s.rate_rad_s);
  a("peak", s.peak);
  a("stir", s.stir);
}

template <class A, Like<cable::ContactDetectorState> T>
void visit(A& a, T& s) {
  a("state", s.state);
  a("force_N", s.force_N);
  a("sd_N", s.sd_N);
  a("dithered_N", s.dithered_N);
  a("dithering", s.dithering);
  a("torque_Nm", s.torque_Nm);
  a("sweeps", s.sweeps);
  a("segment", s.segment);
  a("root_Nm", s.root_Nm);
  a("torque", s.torque);
  a("least_misfit", s.least_misfit);
  a("best_place", s.best_place);
}

template <class A, Like<cable::HeldProfile> T>
void visit(A& a, T& s) {
  a("value_rad", s.value_rad);
  a("channel", s.channel);
}

template <class A, Like<cable::PullSum> T>
void visit(A& a, T& s) {
  a("curvature", s.curvature);
  a("pull", s.pull);
}

template <class A, Like<cable::HeldBounds> T>
void visit(A& a, T& s) {
  a("low", s.low);
  a("high", s.high);
}

template <class A, Like<cable::ShapeState> T>
void visit(A& a, T& s) {
  a("rate_rad_s", s.rate_rad_s);
  a("change_rad_s", s.change_rad_s);
  a("wanted_rad_s", s.wanted_rad_s);
  a("pulls", s.pulls);
  a("weight", s.weight);
  a("next_pull", s.next_pull);
  a("is_gathered", s.is_gathered);
  a("tick", s.tick);
  a("held_mask", s.held_mask);
  a("wanted_held", s.wanted_held);
  a("rate_held", s.rate_held);
}

template <class A, Like<cable::LimiterState> T>
void visit(A& a, T& s) {
  a("theta_rad", s.theta_rad);
  a("rate_rad_s", s.rate_rad_s);
  a("reference_rad", s.reference_rad);
  a("limits", s.limits);
}

template <class A, Like<cable::SegmentTrig> T>
void visit(A& a, T& s) {
  a("sin_pitch", s.sin_pitch);
  a("cos_pitch", s.cos_pitch);
  a("sin_yaw", s.sin_yaw);
  a("cos_yaw", s.cos_yaw);
}

template <class A, Like<cable::Jacobian> T>
void visit(A& a, T& s) {
  a("linear", s.linear);
  a("angular", s.angular);
}

template <class A, Like<cable::ArmKinematics> T>
void visit(A& a, T& s) {
  a("node_in_base", s.node_in_base);
  a("tip_in_base", s.tip_in_base);
  a("tip_jacobian", s.tip_jacobian);
}

template <class A, Like<cable::IkResult> T>
void visit(A& a, T& s) {
  a("position_error_m", s.position_error_m);
  a("attitude_error_rad", s.attitude_error_rad);
  a("outcome", s.outcome);
  a("residual", s.residual);
  a("limit_mask", s.limit_mask);
}

template <class A, Like<cable::GovernorState> T>
void visit(A& a, T& s) {
  a("mass_kg_m2", s.mass_kg_m2);
  a("pull_N_s2", s.pull_N_s2);
  a("room_N", s.room_N);
  a("accel_rad_s2", s.accel_rad_s2);
  a("cycle", s.cycle);
  a("linear_share", s.linear_share);
  a("angular_share", s.angular_share);
  a("speed_share", s.speed_share);
  a("turn_share", s.turn_share);
}

template <class A, Like<cable::MotionState> T>
void visit(A& a, T& s) {
  a("from", s.from);
  a("to", s.to);
  a("turn_rad", s.turn_rad);
  a("interval_tick", s.interval_tick);
  a("braking", s.braking);
  a("filter", s.filter);
  a("ik_rad", s.ik_rad);
  a("shape", s.shape);
  a("held", s.held);
  a("held_mask", s.held_mask);
  a("held_at_target", s.held_at_target);
  a("limiter", s.limiter);
  a("brake", s.brake);
  a("trig", s.trig);
  a("arm", s.arm);
  a("ik", s.ik);
  a("governor", s.governor);
  a("limits", s.limits);
}

template <class A, Like<cable::SlipState> T>
void visit(A& a, T& s) {
  a("sigma", s.sigma);
  a("part_m", s.part_m);
}

template <class A, Like<cable::CableGeometry> T>
void visit(A& a, T& s) {
  a("length_m", s.length_m);
  a("part_m", s.part_m);
  a("jacobian_m_rad", s.jacobian_m_rad);
}

template <class A, Like<cable::CableSolver::Segment> T>
void visit(A& a, T& s) {
  a("pp", s.pp);
  a("pq", s.pq);
  a("qq", s.qq);
  a("inverse_det", s.inverse_det);
}

template <class A, Like<cable::CableSolver> T>
void visit(A& a, T& s) {
  a("segment", s.segment);
}

template <class A, Like<cable::CableModel> T>
void visit(A& a, T& s) {
  a("theta_rad", s.theta_rad);
  a("geometry", s.geometry);
  a("solver", s.solver);
}

template <class A, Like<cable::SegmentReleaseState> T>
void visit(A& a, T& s) {
  a("stage", s.stage);
  a("segment", s.segment);
  a("cable", s.cable);
  a("ticks", s.ticks);
}

template <class A, Like<cable::DampingState> T>
void visit(A& a, T& s) {
  a("standing_rad", s.standing_rad);
  a("shift_rad", s.shift_rad);
  a("output_rad", s.output_rad);
}

template <class A, Like<cable::DitherState> T>
void visit(A& a, T& s) {
  a("share", s.share);
  a("turn", s.turn);
  a("settle_s", s.settle_s);
}

template <class A, Like<cable::TensionPlan> T>
void visit(A& a, T& s) {
  a("motor_N", s.motor_N);
  a("load_Nm", s.load_Nm);
  a("spread_N", s.spread_N);
  a("floor_acted", s.floor_acted);
  a("ceiling_exceeded", s.ceiling_exceeded);
  a("balanced", s.balanced);
}

}  // namespace liana::recording
