#include "firmware_like/controller.hpp"

#include <cmath>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana {
namespace {

using Index = std::size_t;

// A setpoint the core can use: finite, poses valid, angles inside the limits (the release step has checked the same; this is the second
// lock).
bool is_usable(const RobotTable& table, const Setpoint& setpoint) noexcept {
  if (setpoint.kind != CommandKind::kTip && setpoint.kind != CommandKind::kJoint) return true;
  for (std::int32_t i = 0; i < table.theta_count(); ++i) {
    const double limit = table.segment[as_index(i / 2)].theta_limit_rad;
    if (!(std::fabs(setpoint.joint_rad[as_index(i)]) <= limit) || !(std::fabs(setpoint.held_rad[as_index(i)]) <= limit)) return false;
  }
  if (setpoint.kind == CommandKind::kJoint) return true;
  for (const NodeTarget& target : setpoint.node) {
    if (target.node < 0 || target.node > table.segment_count) return false;
    if (!is_finite(dot(target.position_m, target.position_m)) || !(target.weight >= 0.0) || !is_finite(target.weight)) return false;
    if (!(target.threshold_m >= 0.0)) return false;
  }
  for (const KeepClear& target : setpoint.clear) {
    if (!is_finite(dot(target.centre_m, target.centre_m)) || !(target.weight >= 0.0) || !is_finite(target.weight)) return false;
    if (!(target.distance_m >= 0.0) || !is_finite(target.distance_m)) return false;
  }
  return is_valid(setpoint.tip_in_base) && setpoint.tip_speed_m_s > 0.0;
}

double smooth_step(double x) noexcept { return x * x * (3.0 - 2.0 * x); }

}  // namespace

Controller::Controller(const RobotTable& table) noexcept : table_(table), layout_(cable_layout(table)) {
  for (Index c = 0; c < as_index(table.cable_count()); ++c) zero_payout_m_[c] = layout_.zero_length_m[c] + table.lead_m;
  gate_limits_ = make_gate_limits(table, zero_payout_m_);
  watchdog_limits_ = make_watchdog_limits(table);
  cable_watch_limits_ = make_cable_watch_limits(table, zero_payout_m_);
  reset_motion(table_, ThetaVector{}, motion_);
  take_geometry();
  update_tension_ratio(table_, layout_, motion_.trig, slip_, ratio_);
}

Outputs Controller::tick(const Inputs& inputs) noexcept {
  limits_ = 0;
  read_drives(inputs);  // lengths, tensions, measured angles
  const std::int32_t wrong = watch_all(inputs);
  const bool stop = active_.setpoint().kind == CommandKind::kStop;
  const MotionStatus status{stop, homed(), at_rest_, ramp_ >= 1.0 && cables_taut()};
  const Orders orders = supervise(watchdog_limits_, inputs, status, wrong, supervisor_, faults_);
  take_telecommand(inputs);        // what is in force now
  move(inputs, orders);            // filter, IK, limiter: commanded angles
  plan_payouts(orders);            // damping, tension plan, cable map: commanded lengths
  command_drives(inputs, orders);  // the gate, then CiA 402
  return report(inputs, orders);
}

void Controller::read_drives(const Inputs& inputs) noexcept {
  feedback_age_ticks_ = 0;
  for (Index c = 0; c < cables(); ++c) {
    const DriveFeedback& drive = inputs.drive[c];
    if (drive.feedback_age_ticks > feedback_age_ticks_) feedback_age_ticks_ = drive.feedback_age_ticks;
    payout_measured_m_[c] = payout_at_counts(table_.drive[c], zero_payout_m_[c], drive.position_counts);
    tension_measured_N_[c] = table_.drive[c].newtons_per_permille * drive.torque_permille;
  }
  if (feedback_age_ticks_ == 0xFFFF) return;  // a drive was never heard
  const bool all_fresh = feedback_age_ticks_ <= kFeedbackAgeTicks;
  estimate(table_, layout_, model_, ratio_, payout_measured_m_, tension_measured_N_, estimator_);
  double residual_m = 0.0;
  for (Index c = 0; c < cables(); ++c) residual_m = larger(residual_m, std::fabs(estimator_.residual_m[c]));
  const bool plausible = all_fresh && estimator_.largest_step_rad < kHomingStep_rad && residual_m < kHomingResidual_m;
  // Once homed, a moving arm may well step further; only before that does the estimate have to settle.
  if (plausible && homing_ticks_ < kHomingTicks) ++homing_ticks_;
  if (!plausible && !homed()) homing_ticks_ = 0;
  if (!all_fresh || residual_m > 4.0 * kHomingResidual_m) homing_ticks_ = 0;
}

// What is wrong with drives, buses, clock and cables; returns how many of it are wrong now.
std::int32_t Controller::watch_all(const Inputs& inputs) noexcept {
  const WatchScope scope = watch_scope(supervisor_);
  const std::int32_t wrong = watch(watchdog_limits_, scope, inputs, sent_, tension_measured_N_, estimator_.tension_N, watchdogs_, faults_);
  const CableReadings cables{payout_measured_m_, tension_measured_N_, model_.geometry.length_m, estimator_.residual_m};
  const bool usable = scope.tensioned && feedback_age_ticks_ == 0 && faults_.count == 0;
  watch_cables(table_, cable_watch_limits_, cables, usable, inputs.tick, cable_watch_, faults_);
  return wrong;
}

bool Controller::cables_taut() const noexcept {
  for (Index c = 0; c < cables(); ++c) {
    if (!(estimator_.tension_N[c] >= kSlackCheckShare * table_.tension.floor_motor_N)) return false;
  }
  return true;
}

void Controller::reject_telecommand(const Inputs& inputs) noexcept {
  Fault fault;
  fault.number = FaultNumber::kCommandInvalid;
  fault.detail = narrow<std::uint16_t>(inputs.telecommand.sequence() & 0xFFFFu);
  fault.tick = inputs.tick;
  latch(faults_, fault);
}

void Controller::take_telecommand(const Inputs& inputs) noexcept {
  const Telecommand& offered = inputs.telecommand;
  if (offered.setpoint().kind != CommandKind::kNone && offered.sequence() > last_sequence_) {
    last_sequence_ = offered.sequence();
    if (is_usable(table_, offered.setpoint())) {
      pending_ = offered;
    } else {
      reject_telecommand(inputs);
    }
  }
  const bool due = pending_.setpoint().kind != CommandKind::kNone && pending_.first_tick() <= inputs.tick;
  if (due) {
    active_ = pending_;
    pending_ = Telecommand{};
    const CommandKind kind = active_.setpoint().kind;
    if (kind == CommandKind::kTip || kind == CommandKind::kJoint) accept_setpoint(table_, active_.setpoint(), motion_);
    if (kind == CommandKind::kHold || kind == CommandKind::kStop) motion_.braking = true;
  }
  if (active_.sequence() != 0 && active_.expiry_tick() <= inputs.tick) {
    if (!motion_.braking) limits_ |= kLimitExpired;
    motion_.braking = true;
  }
}

void Controller::move(const Inputs&, const Orders& orders) noexcept {
  if (!orders.live_targets) {  // the arm stands where its brakes hold it: start from there
    reset_motion(table_, estimator_.theta_rad, motion_);
    active_ = Telecommand{};
  } else {
    if (!orders.motion_allowed) motion_.braking = true;
    advance_motion(table_, model_.geometry, orders.motion_allowed, motion_);
    limits_ |= motion_.limits;
  }
  at_rest_ = at_rest(table_, motion_);
}

void Controller::limit_payout_speed(CableVector& wanted_m) noexcept {
  const double step_m = table_.limits.cable_speed_m_s * table_.tick_s;
  for (Index c = 0; c < cables(); ++c) {
    const double change = wanted_m[c] - payout_command_m_[c];
    if (std::fabs(change) <= step_m) continue;
    wanted_m[c] = payout_command_m_[c] + (change > 0.0 ? step_m : -step_m);
    limits_ |= kLimitCableSpeed;
  }
}

void Controller::ramp_payouts(CableVector& wanted_m) const noexcept {
  const double share = smooth_step(ramp_);
  for (Index c = 0; c < cables(); ++c) wanted_m[c] = ramp_start_m_[c] + share * (wanted_m[c] - ramp_start_m_[c]);
}

// Moves the motors after the swing that the measured tensions show; while a fault makes tensions doubtful the last shift stays.
void Controller::damp_payouts(CableVector& wanted_m) noexcept {
  if (faults_.count == 0) {
    // A cable stretches in proportion to its tension (to 0.3 %); as planned it is stretched by the path less the unstretched length.
    CableVector stretch_m;
    for (Index c = 0; c < cables(); ++c) {
      const double planned_N = larger(tension_.motor_N[c], table_.tension.floor_anywhere_N);
      stretch_m[c] = (estimator_.tension_N[c] / planned_N - 1.0) * (model_.geometry.length_m[c] + table_.lead_m - wanted_m[c]);
    }
    damp(table_, model_.geometry, model_.solver, stretch_m, damping_);
  }
  // The shift is small (kDampingLimit_rad): what its square adds to a length is below 20 um.
  for (Index c = 0; c < cables(); ++c) {
    const double* const row = model_.geometry.jacobian_m_rad[c].data();
    wanted_m[c] += dot_pairs(row, damping_.output_rad.data(), as_index(layout_.segment[c]) + 1);
  }
}

void Controller::take_geometry() noexcept {
  model_.theta_rad = motion_.limiter.theta_rad;
  update_cable_geometry(table_, layout_, motion_.trig, model_.geometry);
  update_cable_solver(table_, model_.geometry, model_.solver);
}

void Controller::plan_payouts(const Orders& orders) noexcept {
  take_geometry();
  if (!orders.live_targets || !live_) reset_slip(model_.geometry, slip_);
  advance_slip(layout_, model_.geometry, slip_);
  update_tension_ratio(table_, layout_, motion_.trig, slip_, ratio_);
  if (!orders.live_targets) {
    live_ = false;
    ramp_ = 0.0;
    damping_ = DampingState{};
    lift_N_ = SegmentVector{};
    payout_command_m_ = payout_measured_m_;
    return;
  }
  if (!live_) {
    for (Index c = 0; c < cables(); ++c) ramp_start_m_[c] = payout_at_counts(table_.drive[c], zero_payout_m_[c], sent_[c].target_counts);
    payout_command_m_ = ramp_start_m_;
    live_ = true;
  }
  if (orders.ramp_active) ramp_ = smaller(1.0, ramp_ + table_.tick_s / kPretensionRamp_s);

  if (ramp_ >= 1.0 && faults_.count == 0) keep_taut(table_, estimator_.tension_N, lift_N_);
  tension_ = plan_tension(table_, model_.geometry, ratio_, lift_N_);
  if (tension_.floor_acted) limits_ |= kLimitTensionFloor;
  if (tension_.ceiling_exceeded) limits_ |= kLimitTensionCeiling;

  CableVector wanted_m = payout_for(table_, layout_, model_.geometry.part_m, ratio_, tension_.motor_N);
  if (ramp_ < 1.0) {
    ramp_payouts(wanted_m);
  } else {
    damp_payouts(wanted_m);
  }
  limit_payout_speed(wanted_m);
  payout_command_m_ = wanted_m;
}

void Controller::command_drives(const Inputs& inputs, const Orders& orders) noexcept {
  const GateProposal proposal{orders.goal, orders.live_targets, payout_command_m_, tension_.motor_N};
  const GateResult result = gate(table_, gate_limits_, proposal, sent_, inputs.drive);
  if (result.check != GateCheck::kPassed) {
    limits_ |= kLimitGate;
    latch(faults_, gate_fault(result, inputs.tick));
  }
  sent_ = result.command;
}

Outputs Controller::report(const Inputs& inputs, const Orders& orders) const noexcept {
  Outputs out;
  out.tick = inputs.tick;
  out.state = orders.state;
  out.stop_category = orders.stop_category;
  out.limits = limits_;
  out.held_mask = motion_.held_mask;
  out.held_at_target = motion_.held_at_target ? 1 : 0;
  out.at_rest = at_rest_ ? 1 : 0;
  out.homed = homed() ? 1 : 0;
  out.active_sequence = motion_.braking ? 0 : active_.sequence();
  out.faults = faults_;
  out.drive = sent_;
  out.theta_command_rad = motion_.limiter.theta_rad;
  out.theta_rate_rad_s = motion_.limiter.rate_rad_s;
  out.theta_measured_rad = estimator_.theta_rad;
  out.tip_goal = motion_.filter.pose;
  out.tip_command = motion_.arm.tip_in_base;
  const Twist tip = tip_twist(table_, motion_);
  out.tip_speed_m_s = norm(tip.linear_m_s);
  out.tip_rate_rad_s = norm(tip.angular_rad_s);
  for (Index m = 0; m < as_index(table_.segment_count); ++m) out.node_command_m[m] = motion_.arm.node_in_base[m + 1].position_m;
  out.tension_plan_N = tension_.motor_N;
  out.tension_measured_N = tension_measured_N_;
  out.payout_command_m = payout_command_m_;
  out.ik_position_error_m = motion_.ik.position_error_m;
  out.ik_attitude_error_rad = motion_.ik.attitude_error_rad;
  out.ik_outcome = motion_.ik.outcome;
  out.ik_residual = motion_.ik.residual;
  return out;
}

}  // namespace liana
