#include "host/control/arbiter/cable_arbiter.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "host/api/server/request_error.hpp"

namespace liana::arbiter {

namespace {

constexpr double kLeastShare = 0.02;  // a setpoint has a speed, also one that stays
constexpr double kLagTold = 0.75;     // of the tip's speed: every arm lags a little
// A hand that turns away from what slowed it is not let go all at once.
constexpr double kEaseRise_1_s = 2.0;
// The tip goes on as it was commanded until a new setpoint acts.
constexpr double kIntervalsAhead = 3.0;

// Of what the hand may ask for, in place of a setpoint that was refused; the last is to stay.
constexpr std::array kSlowerWays = {0.5, 0.15, 0.0};
// An arm that its shape's own motion would fold into itself keeps its shape, so that a hand can lead its tip away.
constexpr double kKeepsShape_s = 1.0;
constexpr std::int32_t kTipFreedom = 6;

// The goal no farther than the tip comes in its filter's lag with `share` of its speeds, along its own way.
Pose pulled_in(const cable::RobotParams& table, const Pose& tip, const Pose& goal, double share) {
  const cable::MotionLimits& limits = table.limits;
  const double lag_s = limits.tip_lag_s > 0.0 ? limits.tip_lag_s : limits.tip_speed_m_s / limits.tip_accel_m_s2;
  const double ahead_s = share * (lag_s + kIntervalsAhead * interval_s(table));
  const double shift_m = norm(subtract(goal.position_m, tip.position_m));
  const Vec3 turn_rad = rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion)));
  const double most_s = std::max(shift_m / limits.tip_speed_m_s, norm(turn_rad) / limits.tip_rate_rad_s);
  return most_s <= ahead_s ? goal : interpolated_pose(tip, goal, turn_rad, ahead_s / most_s);
}

}  // namespace

CableArbiter::CableArbiter(const cable::RobotParams& table, const SpeedZone& zone, SearchResult taken,
                           PathCheck<cable::CableArm> check, const virtual_fixtures::Guidance& guidance)
    : Arbiter(table, zone, taken, std::move(check)),
      asked_speed_m_s_(table.limits.tip_speed_m_s),
      robot_speed_m_s_(table.limits.tip_speed_m_s),
      cap_m_s_(table.limits.tip_speed_m_s),
      interval_s_(interval_s(table)),
      lead_(table, taken),
      catch_up_(interval_s_),
      taut_pace_(this->table(), interval_s_),
      guidance_(guidance) {}

void CableArbiter::require_free(const cable::Outputs& now) const {
  require_ready(now);
  if (is_searching())
    throw api::RequestError("busy",
                            "the shape that a search has found is gone to: wait until it has settled or send hold");
  if (dither_.is_under_way())
    throw api::RequestError("busy", "tensions are dithered: wait until it is over or send hold");
  Base::require_free(now);
  if (device_.engaged()) throw api::RequestError("busy", "the operator steers: wait for the deadman to open");
}

// The tip stays where it is, unless somebody moves it.
void CableArbiter::ask_objectives_anew(const cable::Outputs& now) {
  ask_anew();
  lead_.ask_anew();
  if (!device_.engaged()) stay_if_idle(now);
}

void CableArbiter::hold_theta(const cable::Outputs& now, std::uint32_t mask, const cable::ThetaVector& held_rad) {
  require_ready(now);
  wishes().held_mask = mask;
  wishes().held_rad = held_rad;
  ask_objectives_anew(now);
}

void CableArbiter::shape(const cable::Outputs& now, const cable::NodeTargets& nodes,
                         const cable::KeepClearTargets& clear, bool search) {
  require_ready(now);
  if (search && is_busy())
    throw api::RequestError("busy",
                            "search needs an arm at rest, a planned move is under way: wait for it or send hold");
  if (search && now.at_rest == 0)
    throw api::RequestError("busy", "search looks for a shape of the arm at rest: wait for it or send hold");
  lead_.forget();
  const CableObjectives& held = wishes();
  if (search) lead_.look_for({now.tip_command, now.theta_command_rad, held.held_mask, held.held_rad, nodes, clear});
  nodes_ = nodes;
  wishes().clear = clear;
  ask_objectives_anew(now);
}

bool CableArbiter::is_vr_in_slit(const cable::Outputs& now, const DeviceUse& use) const {
  return use.kind == device::Kind::kVrControllers && !use.anywhere && zone().holds(now.tip_command.position_m);
}

// A hand that leads the tip would find it going another way under it.
void CableArbiter::require_open_clutch(const DeviceUse& use) const {
  const DeviceUse& in_use = device_.in_use();
  if (!device_.engaged() || use.kind != in_use.kind || use.mapping == in_use.mapping) return;
  throw api::RequestError("busy",
                          "the operator steers: scale, rotation_scale and frame of the device in use change while the "
                          "deadman is open: wait for that, or say device = none first, which holds the arm");
}

void CableArbiter::use_device(const cable::Outputs& now, const DeviceUse& use) {
  if (is_vr_in_slit(now, use))
    throw api::RequestError(
        "refused", "device = " + use.name + ": the tip is inside the slit: use hand there, or say anywhere = true");
  if (is_busy()) throw api::RequestError("busy", "a planned move is under way: wait for it or send hold");
  require_open_clutch(use);
  if (was_engaged_) Base::hold();  // the tip does not go on to where the hand before has led it
  take_device_away();
  device_.use(use);
  asked_speed_m_s_ = use.speed_m_s > 0.0 ? use.speed_m_s : robot_speed_m_s_;
  cap_tip_speed(cap_m_s_);
}

void CableArbiter::dither(const cable::Outputs& now, double share, double duration_s) {
  require_free(now);
  if (now.at_rest == 0) throw api::RequestError("busy", "dither needs an arm at rest: wait for it or send hold");
  const cable::TensionLimits& limits = table().tension;
  // What is measured, and may be less where something pushes, has to stay taut; what is planned keeps its limits.
  const double taut_N = cable::kSlackCheckShare * limits.floor_motor_N;
  double fits = share;
  for (std::size_t c = 0; c < static_cast<std::size_t>(table().cable_count()); ++c) {
    const double planned_N = now.tension_plan_N[c];
    fits = std::min({fits, 1.0 - limits.floor_motor_N / planned_N, limits.ceiling_free_N / planned_N - 1.0,
                     (now.tension_measured_N[c] - taut_N) / planned_N});
  }
  if (fits < share) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "share = %.3g: tensions stay between %.0f and %.0f N, and cables taut, up to %.3g here: ask for less",
                  share, limits.floor_motor_N, limits.ceiling_free_N, std::max(0.0, fits));
    throw api::RequestError("refused", text);
  }
  dither_ = DitherOrder(share, duration_s);
  dithered_at_rad_ = now.theta_command_rad;
}

void CableArbiter::carry(const cable::Outputs& now, const cable::TipLoad& payload, PathCheck<cable::CableArm> check) {
  require_free(now);
  if (now.at_rest == 0)
    throw api::RequestError("busy", "a payload is taken over by an arm at rest: wait for it or send hold");
  payload_ = payload;
  check_paths_by(std::move(check));
  ask_objectives_anew(now);
}

void CableArbiter::cap_tip_speed(double speed_m_s) {
  cap_m_s_ = speed_m_s;
  ask_speed();
}

void CableArbiter::ask_speed() {
  limit_tip_speed(std::max(kLeastShare, ease_.share) * std::min(asked_speed_m_s_, cap_m_s_));
}

void CableArbiter::end_shape_transition() {
  guidance_.stop();
  refusal_wait_.forget();
  keeps_shape_s_ = 0.0;
  ease_ = {};
  ask_speed();
}

void CableArbiter::take_device_away() {
  device_.use(DeviceUse{});
  device_node_ = {};
  was_engaged_ = false;
}

// The way out takes over from whatever is under way. An operator who could grip again would steer back in as soon as it
// ends.
void CableArbiter::retract(const cable::Outputs& now, std::uint64_t until_tick) {
  Base::retract(now, until_tick);
  dither_ = {};
  nodes_ = {};
  lead_.forget();
  take_device_away();
}

void CableArbiter::hold(const std::string& why) {
  Base::hold(why);
  dither_ = {};
  lead_.forget();
  device_.let_go();
}

bool CableArbiter::refused(const std::string& why, bool may_pass_slower) {
  const bool goes_on = Base::refused(why, may_pass_slower && !was_engaged_);
  dither_ = {};
  if (was_engaged_) refusal_wait_.refuse(led_from_, led_to_);
  return goes_on || was_engaged_;
}

std::optional<cable::Setpoint> CableArbiter::slower(const cable::Outputs& now, const char* limit) {
  if (!was_engaged_ || slower_ways_ == kSlowerWays.size()) return std::nullopt;
  if (slower_ways_ == 0) asked_share_ = ease_.share;
  if (std::string_view(limit) == "self_contact") keeps_shape_s_ = kKeepsShape_s;
  const double share = kSlowerWays[slower_ways_++];
  refusal_wait_.slow(share, limit);
  ease_ = {share * asked_share_, virtual_fixtures::SlowdownCause::kRefused, 0, limit};
  cable::Setpoint setpoint = led_setpoint(now);
  setpoint.payload = payload_;
  return setpoint;
}

std::optional<cable::Setpoint> CableArbiter::next_setpoint(std::uint64_t tick, const cable::Outputs& now) {
  std::optional<cable::Setpoint> setpoint = wished_setpoint(tick, now);
  if (setpoint) setpoint->payload = payload_;
  return setpoint;
}

std::optional<cable::Setpoint> CableArbiter::wished_setpoint(std::uint64_t tick, const cable::Outputs& now) {
  std::optional<TeleopGoal> steer = device_.finish_interval(now, interval_s_);
  if (steer && is_vr_in_slit(now, device_.in_use())) {
    device_.leave_slit();
    steer.reset();
  }
  if (!steer || is_busy()) end_shape_transition();
  if (!begin_interval(tick, now)) {
    hold();
    nodes_ = {};
    catch_up_.forget();
    return std::nullopt;
  }
  catch_up_.note(tip_of(now.theta_command_rad), tip_of(now.theta_measured_rad));
  if (is_busy()) {
    device_.drop_anchor();  // a hand that closes the deadman now starts from where the move ends
    if (dither_.is_under_way()) return dithering_setpoint();
    set_node_objectives();
    return ask(now);
  }
  const ShapeTransition::Found found = lead_.look();
  if (found == ShapeTransition::Found::kNow) ask_anew();
  if (steer) return steered_setpoint(now, *steer);
  if (was_engaged_) Base::hold();  // the operator let go: stop along the path
  was_engaged_ = false;
  ask_speed();
  if (found == ShapeTransition::Found::kNotYet) return std::nullopt;
  if (lead_.ends(now)) ask_anew();
  set_node_objectives();
  return ask(now);
}

cable::Setpoint CableArbiter::dithering_setpoint() {
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kJoint;
  setpoint.joint_rad = dithered_at_rad_;
  setpoint.tip_speed_m_s = robot_speed_m_s_;
  setpoint.dither_share = dither_.next(interval_s_);
  return setpoint;
}

// What is slack with a fault, or released, stays so on the way back.
double CableArbiter::pace_left(const cable::Outputs& now) {
  if (now.faults.count == 0 && !Kind::recovers(table(), now)) return taut_pace_.next(now.tension_measured_N);
  taut_pace_.forget();
  return 1.0;
}

std::optional<cable::Setpoint> CableArbiter::steered_setpoint(const cable::Outputs& now, const TeleopGoal& goal) {
  was_engaged_ = true;
  lead_.ask_anew();
  device_node_ = goal.node;
  set_node_objectives();
  const std::uint32_t held = wishes().held_mask;
  const Pose led = guidance_.guide(goal.tip_in_base, {now.tip_command, now.theta_command_rad, held}, interval_s_);
  if (refusal_wait_.holds(now.tip_command, led, interval_s_)) {
    ease_ = {0.0, virtual_fixtures::SlowdownCause::kRefused, 0, refusal_wait_.limit()};
    return std::nullopt;
  }
  led_from_ = now.tip_command;
  led_to_ = led;
  const double most = ease_.share + kEaseRise_1_s * interval_s_;
  virtual_fixtures::Ease eased = virtual_fixtures::ease(table(), now.theta_command_rad, held, led);
  if (eased.share > most) eased = {most, ease_.cause, ease_.theta, ease_.limit};
  ease_ = eased;
  if (pace() < ease_.share) ease_ = {pace(), virtual_fixtures::SlowdownCause::kTension};
  if (refusal_wait_.speed_share() < ease_.share)
    ease_ = {refusal_wait_.speed_share(), virtual_fixtures::SlowdownCause::kRefused, 0, refusal_wait_.limit()};
  slower_ways_ = 0;
  keeps_shape_s_ = std::max(0.0, keeps_shape_s_ - interval_s_);
  return led_setpoint(now);
}

cable::Setpoint CableArbiter::led_setpoint(const cable::Outputs& now) {
  ask_speed();
  cable::Setpoint setpoint =
      steer(now, ease_.share < 1.0 ? pulled_in(table(), now.tip_command, led_to_, ease_.share) : led_to_);
  if (keeps_shape_s_ > 0.0 && setpoint.held_mask == 0) {
    const std::int32_t kept = std::max(0, table().theta_count() - kTipFreedom);
    setpoint.held_mask = (1u << kept) - 1u;
    setpoint.held_rad = now.theta_command_rad;
  }
  return setpoint;
}

Vec3 CableArbiter::tip_of(const cable::ThetaVector& theta_rad) const {
  return tip_pose(table(), arm_trig(table(), theta_rad)).position_m;
}

double CableArbiter::speed_left_m_s(const Vec3& way_m, double limit_m_s) {
  const double left_m_s = catch_up_.speed_m_s(way_m, limit_m_s);
  lag_share_ = left_m_s / limit_m_s;
  return std::max(kLeastShare * limit_m_s, left_m_s);
}

virtual_fixtures::Ease CableArbiter::ease() const {
  if (!was_engaged_ || lag_share_ > kLagTold || lag_share_ >= ease_.share) return ease_;
  return {lag_share_, virtual_fixtures::SlowdownCause::kLag};
}

// The operator's node takes the place of its own target, or one that is free.
void CableArbiter::set_node_objectives() {
  cable::NodeTargets& wished = wishes().nodes;
  wished = is_searching() ? lead_.nodes() : nodes_;
  if (device_node_.node == 0) return;
  for (cable::NodeTarget& slot : wished) {
    if (slot.node != 0 && slot.node != device_node_.node) continue;
    slot = device_node_;
    break;
  }
}

}  // namespace liana::arbiter
