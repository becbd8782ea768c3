#include "firmware_like/cable/cable_arm.hpp"

#include <cmath>

#include "firmware_like/cable/arm/drive_limits.hpp"
#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/safety/limits.hpp"

namespace liana::cable {
namespace {

double smooth_step(double x) noexcept { return x * x * (3.0 - 2.0 * x); }

ContactStatus contact_report(const ContactDetectorState& contact) noexcept {
  ContactStatus out;
  out.sd_N = contact.sd_N;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_seen(contact, i)) continue;
    out.force_N[i] = contact.force_N[i];
    out.seen = narrow<std::uint8_t>(out.seen | 1u << i);
  }
  out.state = contact.state;
  out.on_body = is_in_contact(contact) ? 1 : 0;
  out.segment = contact.segment + 1;
  out.torque_Nm = contact.torque_Nm;
  return out;
}

// The first slack cable from `from` on, beside those that the arm does without; -1: none. Rare, and no part of a normal
// tick.
[[gnu::noinline]] std::int16_t slack_from(const CableVector& tension_N, double enough_N, const CableLayout& layout,
                                          const SegmentReleaseState& lost, std::size_t from) noexcept {
  for (std::size_t c = from; c < as_index(layout.cable_count); ++c) {
    const bool is_missed = !does_without(lost) || !is_released(lost, layout, c);
    if (!(tension_N[c] >= enough_N) && is_missed) return narrow<std::int16_t>(c);
  }
  return -1;
}

}  // namespace

CableArm::CableArm(const RobotParams& table) noexcept
    : table_(table),
      declared_mu_(table.friction_mu),
      declared_tool_(table.tool),
      layout_(cable_layout(table)),
      first_cable_(table.feed_count()),
      cables_with_cells_(cables_with_cells(table)),
      tension_watch_limits_(make_tension_watch_limits(table)) {
  for (Index c = 0; c < cables(); ++c) zero_payout_m_[c] = layout_.zero_length_m[c] + table.lead_m;
  for (Index c = 0; c < cables(); ++c) {
    if (!reports_torque(table, c)) pull_N_[c] = table.tension.plan_N;  // what brakes hold, until it is planned
  }
  cable_watch_limits_ = make_cable_watch_limits(table, zero_payout_m_);
  torque_limits_ = make_torque_limits(table);
  reset_friction_watch(declared_mu_, friction_);
  reset_motion(table_, ThetaVector{}, motion_);
  take_geometry();
  wrap_rad_ = cable_wraps(table_, motion_.trig);
  update_tension_ratio(table_, layout_, wrap_rad_, slip_, ratio_);
}

GateLimits CableArm::gate_limits() const noexcept { return make_gate_limits(table_, zero_payout_m_); }

LinkLimits CableArm::link_limits() const noexcept { return make_link_limits(table_); }

// --- from the drives ---

void CableArm::read(const DriveFeedbacks& drives, const LoadCells& cells) noexcept {
  if (first_cable_ != 0)
    feed_ = read_feed(table_, drives, zero_payout_m_, payout_measured_m_, feedback_age_ticks_ != 0xFFFF);
  feedback_age_ticks_ = 0;
  for (Index c = 0; c < cables(); ++c) {
    const DriveFeedback& drive = drives[c];
    if (drive.feedback_age_ticks > feedback_age_ticks_) feedback_age_ticks_ = drive.feedback_age_ticks;
    payout_measured_m_[c] = payout_at_counts(table_.drive[c], zero_payout_m_[c], drive.position_counts);
    tension_measured_N_[c] = table_.drive[c].newtons_per_permille * drive.torque_permille;
  }
  if (table_.no_torque != 0) take_planned_tensions();
  if (first_cable_ != 0) tension_measured_N_[0] = tension_measured_N_[1] = 0.0;
  if (cables_with_cells_ != 0) read_cells(cells);
  if (feedback_age_ticks_ == 0xFFFF) return;  // a drive was never heard
  estimate(table_, layout_, model_, ratio_, payout_measured_m_, tension_measured_N_, estimator_);
  count_homing();
}

void CableArm::read_cells(const LoadCells& cells) noexcept {
  for (Index c = 0; c < cables(); ++c) {
    if (has_load_cell(table_, c))
      tension_measured_N_[c] = believed_tension_N(table_, cells, c, tension_measured_N_[c], load_cells_);
  }
}

// Of drives that report no torque.
void CableArm::take_planned_tensions() noexcept {
  for (Index c = first_cable(); c < cables(); ++c)
    if (!reports_torque(table_, c)) tension_measured_N_[c] = pull_N_[c];
}

void CableArm::count_homing() noexcept {
  const bool all_fresh = feedback_age_ticks_ <= kFeedbackAgeTicks;
  double residual_m = 0.0;
  for (Index c = 0; c < cables(); ++c) residual_m = larger(residual_m, std::fabs(estimator_.residual_m[c]));
  const bool plausible = all_fresh && estimator_.largest_step_rad < kHomingStep_rad && residual_m < kHomingResidual_m;
  // Once homed, a moving arm may well step further; only before that does the estimate have to settle.
  if (plausible && homing_ticks_ < kHomingTicks) ++homing_ticks_;
  if (!plausible && !is_homed()) homing_ticks_ = 0;
  if (!all_fresh || residual_m > 4.0 * kHomingResidual_m) homing_ticks_ = 0;
}

std::int16_t CableArm::slack_cable() const noexcept {
  const double enough_N = kSlackCheckShare * table_.tension.floor_motor_N;
  for (Index c = first_cable(); c < cables(); ++c) {
    if (!(estimator_.tension_N[c] >= enough_N)) return slack_from(estimator_.tension_N, enough_N, layout_, let_go_, c);
  }
  return -1;
}

ArmStatus CableArm::status() const noexcept {
  const bool is_ramped = ramp_ >= 1.0;
  const std::int16_t slack = is_ramped ? slack_cable() : std::int16_t{-1};
  return {is_homed(), at_rest(table_, motion_) && !lets_out_, is_ramped && slack < 0, does_without(let_go_), slack};
}

// --- to commanded angles ---

// The arm stands where its brakes hold it: motion starts from there.
void CableArm::stand() noexcept { reset_motion(table_, estimator_.theta_rad, motion_); }

std::uint32_t CableArm::advance(bool allowed) noexcept {
  advance_motion(table_, model_.geometry, allowed, motion_);
  return motion_.limits;
}

void CableArm::take_geometry() noexcept {
  model_.theta_rad = motion_.limiter.theta_rad;
  update_cable_geometry(table_, layout_, motion_.trig, model_.geometry);
  update_cable_solver(table_, model_.geometry, model_.solver);
}

// --- to the drives ---

// Friction stays as it is while the motors stand: the next enabling knows of it. Where one has turned, nothing is
// known.
void CableArm::keep_slip() noexcept {
  slip_.part_m = model_.geometry.part_m;
  if (live_) ramp_start_m_ = payout_measured_m_;
  bool stands = true;
  for (Index c = 0; c < cables(); ++c)
    stands = stands && std::fabs(payout_measured_m_[c] - ramp_start_m_[c]) <= kPreslidingDistance_m;
  if (stands) return;
  reset_slip(model_.geometry, slip_);
  ramp_start_m_ = payout_measured_m_;
}

// Targets are not live: lengths follow the drives, and the next enabling starts anew.
void CableArm::stop_planning() noexcept {
  live_ = false;
  plan_rate_rad_s_ = ThetaVector{};
  ramp_ = 0.0;
  damping_ = DampingState{};
  lift_N_ = SegmentVector{};
  taut_N_ = CableVector{};
  dither_ = DitherState{};
  if (is_let_go(let_go_) && !does_without(let_go_)) let_go_ = SegmentReleaseState{};
  lets_out_ = false;
  payout_command_m_ = payout_measured_m_;
}

void CableArm::start_ramp(const DriveCommands& sent) noexcept {
  for (Index c = 0; c < cables(); ++c) {
    ramp_start_m_[c] = payout_at_counts(table_.drive[c], zero_payout_m_[c], sent[c].target_counts);
  }
  payout_command_m_ = ramp_start_m_;
  live_ = true;
}

// What is in force goes evenly to where the plan will be when the next one is made: it never jumps, and does not lag.
// Near the floor it goes no lower than the plan itself: what goes on falling seldom does.
void CableArm::aim_tensions(const TensionPlan& plan) noexcept {
  const CableVector in_force_N = live_ ? tension_.motor_N : plan.motor_N;
  const ThetaVector in_force_Nm = live_ ? tension_.load_Nm : plan.load_Nm;
  if (!live_) planned_N_ = plan.motor_N, planned_Nm_ = plan.load_Nm;
  for (Index k = 0; k < as_index(table_.theta_count()); ++k)
    load_change_Nm_[k] = (2.0 * plan.load_Nm[k] - planned_Nm_[k] - in_force_Nm[k]) / kPlanTicks;
  planned_Nm_ = plan.load_Nm;
  for (Index c = first_cable(); c < cables(); ++c) {
    const double ahead_N = smaller(table_.tension.ceiling_free_N, 2.0 * plan.motor_N[c] - planned_N_[c]);
    const double low_N = smaller(plan.motor_N[c], table_.tension.floor_motor_N + kAheadOver_N * table_.tension.scale());
    const double next_N = larger(larger(table_.tension.floor_motor_N, low_N), ahead_N);
    tension_change_N_[c] = (next_N - in_force_N[c]) / kPlanTicks;
  }
  planned_N_ = plan.motor_N;
  tension_ = plan;
  tension_.motor_N = in_force_N;
  tension_.load_Nm = in_force_Nm;
}

// What the arm's mass takes, as the command has accelerated since the last plan.
ThetaVector CableArm::inertia_load_Nm() noexcept {
  const ThetaVector& rate_rad_s = motion_.limiter.rate_rad_s;
  const Index thetas = as_index(table_.theta_count());
  ThetaVector accel_rad_s2{}, load_Nm{};
  for (Index k = 0; k < thetas; ++k)
    accel_rad_s2[k] = (rate_rad_s[k] - plan_rate_rad_s_[k]) / (kPlanTicks * table_.tick_s);
  plan_rate_rad_s_ = rate_rad_s;
  for (Index k = 0; k < thetas; ++k)
    load_Nm[k] = inertia_torque_Nm(table_, motion_.governor.mass_kg_m2, accel_rad_s2, k);
  return load_Nm;
}

// Tensions never jump: what is told is on the arm a little later.
void CableArm::follow_payload() noexcept {
  const TipLoad goal = joined(declared_tool_, payload_);
  TipLoad& now = table_.tool;
  const double share = smaller(1.0, kPlanTicks * table_.tick_s / kPayload_s);
  now.mass_kg += share * (goal.mass_kg - now.mass_kg);
  for (Index i = 0; i < 3; ++i) now.center_in_tip_m[i] += share * (goal.center_in_tip_m[i] - now.center_in_tip_m[i]);
}

void CableArm::govern() noexcept {
  if (plans_now()) take_room(table_, tension_, motion_.governor);
  look_at_load(table_, model_.geometry, ratio_, motion_.arm, motion_.held_mask, motion_.shape.tick, motion_.governor);
}

void CableArm::look_at_static_load() noexcept {
  if (has_static_load(table_))
    static_load_Nm_ = cable::static_load_Nm(table_, motion_.limiter.theta_rad, motion_.trig, motion_.arm);
}

std::uint32_t CableArm::plan_tensions(bool plans_now, bool tensions_valid) noexcept {
  if (ramp_ >= 1.0 && tensions_valid) keep_min_tension(table_, estimator_.tension_N, lift_N_);
  // On the ramp, too: where friction holds the arm nobody knows yet.
  if (live_ && winds_in_) wind_in(table_, estimator_.tension_N, taut_N_);
  if (does_without(let_go_)) keep_loose();
  if (is_let_go(let_go_)) {  // nothing may lag now
    if (does_without(let_go_) && plans_now) look_at_static_load();
    tension_ = is_loose(let_go_) ? plan_without(table_, layout_, model_.geometry, ratio_, let_go_, static_load_Nm_)
                                 : plan_tension(table_, model_.geometry, ratio_, lift_N_, {static_load_Nm_, {}});
    planned_N_ = tension_.motor_N;
    planned_Nm_ = load_change_Nm_ = ThetaVector{};
    tension_change_N_ = CableVector{};
  } else if (plans_now) {
    follow_payload();
    look_at_static_load();
    aim_tensions(plan_tension(table_, model_.geometry, ratio_, lift_N_, {static_load_Nm_, inertia_load_Nm()}));
  }
  // The sum of even parts may end a last bit over the ceiling, and the gate would refuse that.
  for (Index c = 0; c < cables(); ++c)
    tension_.motor_N[c] = smaller(table_.tension.ceiling_free_N, tension_.motor_N[c] + tension_change_N_[c]);
  for (Index k = 0; k < as_index(table_.theta_count()); ++k) tension_.load_Nm[k] += load_change_Nm_[k];
  std::uint32_t limits = 0;
  if (tension_.floor_acted) limits |= kLimitTensionFloor;
  if (tension_.ceiling_exceeded) limits |= kLimitTensionCeiling;
  return limits;
}

// Damping, tension plan, cable map: commanded lengths. `no_fault`: none is latched.
std::uint32_t CableArm::propose(const Orders& orders, const DriveCommands& sent, bool no_fault,
                                DriveProposals& out) noexcept {
  take_geometry();
  const bool plans = plans_now();
  if (!orders.live_targets || !live_) keep_slip();
  if (plans) wrap_rad_ = cable_wraps(table_, motion_.trig);
  if (!live_ || !shape_worked()) {  // it looks at the whole way since it was last advanced
    advance_slip(layout_, model_.geometry, slip_);
    update_tension_ratio(table_, layout_, wrap_rad_, slip_, ratio_);
  }
  if (!orders.live_targets) {
    stop_planning();
    return 0;
  }
  table_.friction_mu = plan_friction(declared_mu_, table_.friction_mu, table_.tick_s, friction_);
  if (orders.preparing) ramp_ = smaller(1.0, ramp_ + table_.tick_s / kPretensionRamp_s);

  const bool tensions_valid = no_fault && !is_let_go(let_go_);
  std::uint32_t limits = plan_tensions(plans, tensions_valid);
  dither(tensions_valid);
  govern();
  if (!live_) start_ramp(sent);
  CableVector wanted_m = payout_for(table_, layout_, model_.geometry.part_m, ratio_, pull_N_);
  if (ramp_ < 1.0) {
    ramp_payouts(wanted_m);
  } else {
    damp_payouts(tensions_valid, wanted_m);
  }
  wind_beyond_ceiling(wanted_m);
  if (let_go_.stage == SegmentReleaseStage::kOut) let_out(wanted_m);
  const CableVector asked_m = wanted_m;
  const std::uint32_t limited = limit_payout_speed(wanted_m);
  if (limited != 0 && !is_let_go(let_go_)) take_told_tensions(asked_m, wanted_m);
  payout_command_m_ = wanted_m;
  propose_payouts(out);
  lets_out_ = count_let_go(limited == 0, let_go_);
  return limits | limited;
}

// Only an arm at rest is dithered, and one whose tensions are in doubt no more. What friction held is freed by it. What
// single cables are wound in by comes on top.
void CableArm::dither(bool tensions_valid) noexcept {
  const bool may = tensions_valid && !motion_.braking && at_rest(table_, motion_);
  const double change = advance_dither(may ? motion_.to.dither_share : 0.0, table_.tick_s, dither_);
  for (Index c = 0; c < cables(); ++c)
    pull_N_[c] = smaller(table_.tension.ceiling_free_N, (1.0 + change) * tension_.motor_N[c] + taut_N_[c]);
  if (dither_.share > 0.0) fade_slip(layout_, kDitherFade_1_s * dither_.share * table_.tick_s, slip_);
}

// What a cable is wound in by is length, not tension: it is loose, and the ceiling of planned ones is no limit to it.
void CableArm::wind_beyond_ceiling(CableVector& wanted_m) const noexcept {
  for (Index c = 0; c < cables(); ++c) {
    const double beyond_N = tension_.motor_N[c] + taut_N_[c] - table_.tension.ceiling_free_N;
    if (!(beyond_N <= 0.0)) wanted_m[c] -= beyond_N / table_.cable_EA_N * wanted_m[c];
  }
}

// What is released is not wound in.
void CableArm::keep_loose() noexcept {
  for (Index c = 0; c < cables(); ++c) {
    if (is_released(let_go_, layout_, c)) taut_N_[c] = 0.0;
  }
}

void CableArm::let_out(CableVector& wanted_m) const noexcept {
  for (Index c = 0; c < cables(); ++c) {
    if (layout_.segment[c] == let_go_.segment) wanted_m[c] += kSegmentRelease_m;
  }
}

std::uint32_t CableArm::limit_payout_speed(CableVector& wanted_m) const noexcept {
  const double step_m = table_.limits.cable_speed_m_s * table_.tick_s;
  const double out_m = segment_release_begins(let_go_) ? kLetGoStep_m : step_m;
  const bool back = jumps_back(let_go_);
  std::uint32_t limits = 0;
  for (Index c = 0; c < cables(); ++c) {
    const double back_m = back ? larger(step_m, payout_command_m_[c] - payout_measured_m_[c]) : step_m;
    const double change = wanted_m[c] - payout_command_m_[c];
    if (change >= -back_m && change <= out_m) continue;
    wanted_m[c] = payout_command_m_[c] + (change > 0.0 ? out_m : -back_m);
    limits = kLimitCableSpeed;
  }
  return limits;
}

// Lengths that the cable speed keeps from what was planned give other tensions: those are told, not the planned ones.
void CableArm::take_told_tensions(const CableVector& asked_m, const CableVector& told_m) noexcept {
  for (Index c = first_cable(); c < cables(); ++c) {
    const double more_N = table_.cable_EA_N * (asked_m[c] - told_m[c]) / asked_m[c];
    pull_N_[c] = clamp(pull_N_[c] + more_N, 0.0, table_.tension.ceiling_free_N);
  }
}

void CableArm::ramp_payouts(CableVector& wanted_m) const noexcept {
  const double share = smooth_step(ramp_);
  for (Index c = 0; c < cables(); ++c) {
    const double wound_in_m = wanted_m[c] * taut_N_[c] / table_.cable_EA_N;
    wanted_m[c] = ramp_start_m_[c] + share * (wanted_m[c] - ramp_start_m_[c]) - (1.0 - share) * wound_in_m;
  }
}

// Moves the motors after the swing that the measured tensions show; while a fault makes tensions doubtful the last
// shift stays.
void CableArm::damp_payouts(bool tensions_valid, CableVector& wanted_m) noexcept {
  if (tensions_valid) {
    // A cable stretches in proportion to its tension (to 0.3 %); as planned it is stretched by the path less the
    // unstretched length.
    CableVector stretch_m{};
    for (Index c = 0; c < cables(); ++c) {
      const double planned_N = larger(pull_N_[c], table_.tension.floor_anywhere_N);
      const double planned_m = model_.geometry.length_m[c] + table_.lead_m - wanted_m[c];
      stretch_m[c] = (estimator_.tension_N[c] / planned_N - 1.0) * planned_m;
    }
    damp(table_, model_.geometry, model_.solver, stretch_m, damping_);
  }
  // The shift is small (kDampingLimit_rad): what its square adds to a length is below 20 um.
  for (Index c = 0; c < cables(); ++c) {
    const double* const row = model_.geometry.jacobian_m_rad[c].data();
    wanted_m[c] += dot_pairs(row, damping_.output_rad.data(), as_index(layout_.segment[c]) + 1);
  }
}

void CableArm::propose_payouts(DriveProposals& out) const noexcept {
  for (Index c = 0; c < cables(); ++c) {
    out[c].target_counts = counts_at_payout(table_.drive[c], zero_payout_m_[c], payout_command_m_[c]);
    out[c].torque_permille = pull_N_[c] / table_.drive[c].newtons_per_permille;
    out[c].lets_go = segment_release_begins(let_go_) || jumps_back(let_go_);
  }
}

void CableArm::report(Report& out) const noexcept {
  out.held_mask = motion_.held_mask;
  out.held_at_target = motion_.held_at_target ? 1 : 0;
  out.theta_command_rad = motion_.limiter.theta_rad;
  out.theta_rate_rad_s = motion_.limiter.rate_rad_s;
  out.theta_measured_rad = estimator_.theta_rad;
  out.tip_goal = motion_.filter.pose;
  out.tip_command = motion_.arm.tip_in_base;
  const Twist tip = tip_twist(table_, motion_);
  out.tip_speed_m_s = norm(tip.linear_m_s);
  out.tip_rate_rad_s = norm(tip.angular_rad_s);
  for (Index m = 0; m < as_index(table_.segment_count); ++m)
    out.node_command_m[m] = motion_.arm.node_in_base[m + 1].position_m;
  out.speed_share = motion_.governor.speed_share;
  out.turn_share = motion_.governor.turn_share;
  out.lost_share = cable::lost_share(motion_);
  out.load_Nm = tension_.load_Nm;
  out.tension_plan_N = pull_N_;
  out.tension_measured_N = tension_measured_N_;
  out.load_cells = load_cells_.believed;
  out.payout_command_m = payout_command_m_;
  out.friction = {friction_.mu, friction_sd(friction_), table_.friction_mu, std::uint8_t{friction_.flagged}};
  out.contact = contact_report(contact_);
  out.ik_position_error_m = motion_.ik.position_error_m;
  out.ik_attitude_error_rad = motion_.ik.attitude_error_rad;
  out.ik_outcome = motion_.ik.outcome;
  out.ik_residual = motion_.ik.residual;
}

void CableArm::predict_sensors(const RobotParams& table, const Report& report, LoadCells& cells) noexcept {
  const Index count = as_index(table.cable_count());
  for (Index c = 0; c < count; ++c) {
    if (has_load_cell(table, c) && cells.age_ticks[c] <= kLoadCellAgeTicks)
      cells.steps[c] = steps_of(table, c, report.tension_plan_N[c]), cells.age_ticks[c] = 0;
  }
}

}  // namespace liana::cable
