#include "firmware_like/cable/motion/motion.hpp"

#include <cmath>

#include "firmware_like/cable/shape/shape.hpp"
#include "firmware_like/math/braking.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/safety/limits.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

constexpr double kHeldShare = 0.4;                   // of the theta limits that held variables use on their way
constexpr Leash kLeash{0.001, 0.004, 0.001, 0.008};  // the target waits for an arm that does not come after it
constexpr double kFollowRates = 5.0;                 // times a joint's rate: further the IK does not go in a tick
// To a stop the thetas slow down as one, about as fast as the tip does and as smoothly: shares of the theta
// acceleration limit, of the same per second for its change, and of the room for acceleration. Stops from every kind of
// motion keep the tensions of the motion itself (tests/closed_loop/braking_test.cpp).
constexpr double kBrakeAccel = 0.8;
constexpr double kBrakeJerk_1_s = 8.0;
constexpr double kBrakeRoom = 0.8;
// An arm that was held back makes up for it no faster than it can slow down again, with such a share of the tip's
// acceleration; with all that its cables have, at once, it would swing.
constexpr double kCatchUp = 0.3;
constexpr double kWay = 1e-3;  // m and rad: a shorter one is none
// m and rad: from here the target does not wait, or a blocked arm could not be led away
constexpr double kBehind = 1e-4;
constexpr double kHeldNear_rad = 2e-6;    // from here a held variable that has slowed down
constexpr double kHeldSlow_rad_s = 2e-5;  // to this rate
constexpr double kHeldArrival_rad_s =
    7e-5;  // goes the rest straight: others make up for its steps many times magnified

constexpr MotionState kNothing{};  // copied, not made anew: an arm that stands is reset in every tick

bool is_tip(const Setpoint& setpoint) noexcept { return setpoint.kind == CommandKind::kTip; }

FilterBounds held_bounds(const RobotParams& table) noexcept {
  const double rate = kHeldShare * table.limits.theta_rate_rad_s;
  const double accel = 0.2 * table.limits.theta_accel_rad_s2;
  return {rate, accel, 3.0 * accel};
}

// Brings held thetas to their targets and keeps them there to the last bit.
void advance_held(const RobotParams& table, MotionState& state) noexcept {
  const FilterBounds bounds = held_bounds(table);
  state.held_at_target = true;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    if (((state.held_mask >> k) & 1u) == 0) continue;
    HeldProfile& held = state.held[k];
    const double error = state.to.held_rad[k] - held.value_rad;
    if (std::fabs(error) < kHeldNear_rad && std::fabs(held.channel.velocity[0]) < kHeldSlow_rad_s) {
      const double step = kHeldArrival_rad_s * table.tick_s;
      held.value_rad = std::fabs(error) <= step ? state.to.held_rad[k] : held.value_rad + (error < 0.0 ? -step : step);
      held.channel = ChannelState{};
    } else {
      follow_channel(bounds, table.tick_s, {error, 0.0, 0.0}, held.channel);
      held.value_rad += held.channel.velocity[0] * table.tick_s;
    }
    if (held.value_rad != state.to.held_rad[k]) state.held_at_target = false;
    state.ik_rad[k] = held.value_rad;
  }
}

double interval_share(const RobotParams& table, const MotionState& state) noexcept {
  return liana::interval_share(state.interval_tick, table.interval_ticks);
}

Pose interpolated_target(const RobotParams& table, const MotionState& state) noexcept {
  return interpolated_pose(state.from.tip_in_base, state.to.tip_in_base, state.turn_rad, interval_share(table, state));
}

// Takes only a share of this tick's motion, of the target as of the joints: the arm slows down on its path and does not
// leave it.
void slow_down(const RobotParams& table, double share, const Pose& target_before, const ThetaVector& ik_before,
               const FollowStep& step, MotionState& state) noexcept {
  if (step.left2 < kBehind * kBehind) slow_filter(target_before, share, state.filter);
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    state.ik_rad[k] = ik_before[k] + share * (state.ik_rad[k] - ik_before[k]);
    state.shape.rate_rad_s[k] *= share;
    if (((state.held_mask >> k) & 1u) == 0) continue;
    state.held[k].value_rad = state.ik_rad[k];
    slow_channel(share, state.held[k].channel);
    if (state.ik_rad[k] != state.to.held_rad[k]) state.held_at_target = false;
  }
}

// What would brake the arm harder than there is room for goes between what is asked for and on as it goes, the target
// as the joints.
void stay_in_room(const RobotParams& table, const TipFilterState& before, const ThetaVector& ik_before,
                  const FollowStep& step, MotionState& state) noexcept {
  const Index thetas = static_cast<Index>(table.theta_count());
  ThetaVector change_rad{}, accel_rad_s2{};
  for (Index k = 0; k < thetas; ++k) {
    change_rad[k] = state.ik_rad[k] - ik_before[k] - state.limiter.rate_rad_s[k] * table.tick_s;
    accel_rad_s2[k] = change_rad[k] / (table.tick_s * table.tick_s);
  }
  const double taken = room_taken(table, accel_rad_s2, state.governor);
  if (!(taken > 1.0)) return;
  const double share = 1.0 / taken;
  for (Index k = 0; k < thetas; ++k) {
    const double step_rad = state.limiter.rate_rad_s[k] * table.tick_s + share * change_rad[k];
    state.ik_rad[k] = ik_before[k] + step_rad;
    if (((state.held_mask >> k) & 1u) == 0) continue;
    state.held[k].value_rad = state.ik_rad[k];
    state.held[k].channel.velocity[0] = step_rad / table.tick_s;
    if (state.ik_rad[k] != state.to.held_rad[k]) state.held_at_target = false;
  }
  if (step.left2 < kBehind * kBehind) go_between(before, share, table.tick_s, state.filter);
  state.limits |= kLimitThetaAccel;
}

// A shape that is fast already keeps the pace beside the tip until it has slowed down, or it would shoot past.
const ShapePace& shape_pace(const RobotParams& table, const MotionState& state) noexcept {
  if (!state.held_at_target || !at_rest(state.filter)) return kShapeBesideTip;
  double fastest = 0.0;
  for (const double rate : state.shape.rate_rad_s) fastest = larger(fastest, std::fabs(rate));
  return fastest > 1.01 * kShapeAlone.rate_share * table.limits.theta_rate_rad_s ? kShapeBesideTip : kShapeAlone;
}

// Of what the tip lies behind, three coordinates of the residual from `first` on, what waits for later ticks: no more
// than `most`, the length of the leash.
void leave_for_later(double accel, double most, double tick_s, Index first, const std::array<double, 6>& residual,
                     std::array<double, 6>& later) noexcept {
  const double behind2 = residual[first] * residual[first] + residual[first + 1] * residual[first + 1] +
                         residual[first + 2] * residual[first + 2];
  const double at_once = 2.0 * accel * tick_s * tick_s;  // what may be made up for within a tick
  if (behind2 <= at_once * at_once) return;
  const double behind = std::sqrt(behind2);
  const double share = smaller(1.0 - std::sqrt(at_once / behind), most / behind);
  for (Index r = first; r < first + 3; ++r) later[r] = share * residual[r];
}

IkGoal ik_goal(const RobotParams& table, const MotionState& state) noexcept {
  IkGoal goal{state.filter.pose, state.held_mask, kTipCurvature_m, {}};
  const MotionLimits& limits = table.limits;
  const GovernorState& governor = state.governor;
  leave_for_later(kCatchUp * governor.linear_share * limits.tip_accel_m_s2, kLeash.most_m, table.tick_s, 0,
                  state.ik.residual, goal.later);
  leave_for_later(kCatchUp * governor.angular_share * limits.tip_angular_accel_rad_s2, kLeash.max_rad, table.tick_s, 3,
                  state.ik.residual, goal.later);
  return goal;
}

// How far every theta may go in this tick so that it can brake before its limit with what it may brake with by itself:
// the others take over smoothly, before it stands. One that is faster already slows down so.
FollowBounds bounds_before_limits(const RobotParams& table, const MotionState& state) noexcept {
  const double h = table.tick_s, fast = 1.2 * table.limits.theta_rate_rad_s, fast2 = fast * fast;
  FollowBounds out{state.limiter.theta_rad, {}, {}};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double theta = state.limiter.theta_rad[k], rate = state.limiter.rate_rad_s[k];
    const double accel = state.governor.accel_rad_s2[k], limit = table.segment[k / 2].theta_limit_rad;
    out.max_rad[k] = smaller(limit, theta + kFollowRates * fast * h);
    out.min_rad[k] = larger(-limit, theta - kFollowRates * fast * h);
    if (2.0 * accel * (limit - std::fabs(theta)) > fast2) continue;  // far from both
    const double up = larger(braking_speed(larger(0.0, limit - theta), accel, h), rate - accel * h);
    const double down = larger(braking_speed(larger(0.0, limit + theta), accel, h), -rate - accel * h);
    out.max_rad[k] = smaller(limit, theta + up * h);
    out.min_rad[k] = larger(-limit, theta - down * h);
  }
  return out;
}

// Shape and servo IK: angles for the filtered target, from kinematics where the command stands.
FollowStep solve_tip(const RobotParams& table, MotionState& state) noexcept {
  const ThetaVector move = shape_move(table, state.arm, state.to.node, state.to.clear, state.held_mask,
                                      shape_pace(table, state), state.ik_rad, state.shape);
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) state.ik_rad[k] += move[k];
  return follow_ik(table, ik_goal(table, state), state.arm, bounds_before_limits(table, state), state.ik_rad);
}

// How the servo IK did, where the command stands now.
void report_tip(const RobotParams& table, const FollowStep& step, MotionState& state) noexcept {
  state.ik = follow_report(table, ik_goal(table, state), state.arm, step);
  if (state.ik.limit_mask != 0) state.limits |= kLimitTheta;
  if (state.ik.outcome == IkOutcome::kSingular) state.limits |= kLimitSingular;
  if (state.ik.outcome == IkOutcome::kUnreachable) state.limits |= kLimitReach;
}

FollowStep follow_tip(const RobotParams& table, const CableGeometry& geometry, MotionState& state) noexcept {
  const TipFilterState before = state.filter;
  const ThetaVector ik_before = state.ik_rad;
  const TipFilterConfig config = tip_filter_config(table, state.to.tip_speed_m_s, state.governor);
  filter_tip(config, interpolated_target(table, state), state.filter);
  hold_back(kLeash, state.ik.residual, table.tick_s, state.filter);
  advance_held(table, state);
  if (state.filter.speed_limited) state.limits |= kLimitTipSpeed;
  if (state.filter.accel_limited) state.limits |= kLimitTipAccel;
  const FollowStep ik_step = solve_tip(table, state);

  ThetaVector step{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) step[k] = state.ik_rad[k] - ik_before[k];
  const StepShare allowed = allowed_share(table, geometry, step, state.governor, state.limiter);
  state.limits |= allowed.limits;
  if (allowed.share < 1.0) slow_down(table, allowed.share, before.pose, ik_before, ik_step, state);
  stay_in_room(table, before, ik_before, ik_step, state);
  return ik_step;
}

// Joint reference: linear over the command interval; the limiter does the rest.
void follow_joints(const RobotParams& table, MotionState& state) noexcept {
  const double share = interval_share(table, state);
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double limit = larger(table.segment[k / 2].theta_limit_rad, std::fabs(state.limiter.theta_rad[k]));
    const double wanted = state.from.joint_rad[k] + share * (state.to.joint_rad[k] - state.from.joint_rad[k]);
    const double bounded = wanted > limit ? limit : (wanted < -limit ? -limit : wanted);
    if (bounded != wanted) state.limits |= kLimitTheta;
    state.ik_rad[k] = bounded;
  }
}

// Whatever moves comes to rest by one factor for all joints, which the fastest of them gives: they stop together, the
// arm stays on its path, and no inverse is taken where the tip loses a direction. As gentle as the shape's and the
// tip's own stops and as the room for acceleration allows the way the arm goes now, whichever takes longest.
void brake(const RobotParams& table, MotionState& state) noexcept {
  const double fastest = largest_rate(table, state.limiter);
  const Twist tip = tip_twist(table, state);
  const double per_m = fastest / larger(norm(tip.linear_m_s), 1e-9);
  const double per_rad = fastest / larger(norm(tip.angular_rad_s), 1e-9);
  const MotionLimits& limits = table.limits;
  const double taken = room_taken(table, state.limiter.rate_rad_s, state.governor);
  const double own = smaller(limits.theta_accel_rad_s2, kBrakeRoom * fastest / (kBrakeAccel * larger(taken, 1e-9)));
  const FilterBounds bounds{
      limits.theta_rate_rad_s,
      smaller(kBrakeAccel * own, smaller(per_m * limits.tip_accel_m_s2, per_rad * limits.tip_angular_accel_rad_s2)),
      smaller(kBrakeJerk_1_s * own, smaller(per_m * limits.tip_jerk_m_s3, per_rad * limits.tip_angular_jerk_rad_s3))};
  state.brake.velocity[0] = fastest;
  state.brake.acceleration[0] = clamp(state.brake.acceleration[0], -bounds.accel, 0.0);
  brake_channel(bounds, table.tick_s, state.brake);
  const double share = fastest > 0.0 ? larger(0.0, state.brake.velocity[0]) / fastest : 0.0;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    state.ik_rad[k] = state.limiter.theta_rad[k] + share * state.limiter.rate_rad_s[k] * table.tick_s;
    state.limiter.reference_rad[k] = state.limiter.theta_rad[k];
  }
  state.ik = IkResult{};
}

// How the fastest joint speeds up: a stop goes on from there.
void note_brake(const RobotParams& table, MotionState& state) noexcept {
  const double fastest = largest_rate(table, state.limiter);
  state.brake.acceleration = {(fastest - state.brake.velocity[0]) / table.tick_s, 0.0, 0.0};
  state.brake.velocity = {fastest, 0.0, 0.0};
}

// The tip is led on from pose, rates and acceleration of the joints; what they do now lives on as shape velocity, which
// goes over smoothly.
void take_over(const RobotParams& table, MotionState& state) noexcept {
  state.ik_rad = state.limiter.theta_rad;
  const std::uint32_t tick = state.shape.tick;
  state.shape = ShapeState{};
  state.shape.tick = tick;
  state.shape.rate_rad_s = state.limiter.rate_rad_s;
  const Twist tip = tip_twist(table, state);
  const double speeds_up_1_s = state.brake.acceleration[0] / larger(state.brake.velocity[0], 1e-6);
  state.filter = TipFilterState{};
  state.filter.pose = state.arm.tip_in_base;
  state.filter.linear = {tip.linear_m_s, scale(tip.linear_m_s, speeds_up_1_s)};
  state.filter.angular = {tip.angular_rad_s, scale(tip.angular_rad_s, speeds_up_1_s)};
  state.ik = IkResult{};
}

// Of a way [m or rad] worth the name, what slow directions leave of it.
double share_left(const SlowDirections& slow, const Vec3& way) noexcept {
  if (is_even(slow) || dot(way, way) < kWay * kWay) return 1.0;
  return norm(slowed(slow, way)) / norm(way);
}

void take_kinematics(const RobotParams& table, MotionState& state) noexcept {
  update_trig(table, state.limiter.theta_rad, state.trig);
  update_kinematics(table, state.trig, state.arm);
}

}  // namespace

TipFilterConfig tip_filter_config(const RobotParams& table, double tip_speed_m_s,
                                  const GovernorState& governor) noexcept {
  const MotionLimits& limits = table.limits;
  // Where there is little room, acceleration comes more slowly besides: the arm swings about what it is.
  const double linear_share = governor.linear_share, angular_share = governor.angular_share;
  const FilterBounds linear{governor.speed_share * limits.tip_speed_m_s, linear_share * limits.tip_accel_m_s2,
                            linear_share * larger(0.3, linear_share) * limits.tip_jerk_m_s3};
  const FilterBounds angular{governor.turn_share * limits.tip_rate_rad_s,
                             angular_share * limits.tip_angular_accel_rad_s2,
                             angular_share * larger(0.3, angular_share) * limits.tip_angular_jerk_rad_s3};
  const bool lowered = tip_speed_m_s > 0.0 && tip_speed_m_s < linear.speed;
  return {with_lag(linear, limits.tip_lag_s, lowered ? tip_speed_m_s : linear.speed),
          with_lag(angular, limits.tip_lag_s, angular.speed), table.tick_s, &governor.slow_ways, &governor.slow_turns};
}

double lost_share(const MotionState& state) noexcept {
  const GovernorState& governor = state.governor;
  if (!is_tip(state.to) || (is_even(governor.slow_ways) && is_even(governor.slow_turns))) return 1.0;
  const Vec3 way_m = subtract(state.to.tip_in_base.position_m, state.filter.pose.position_m);
  const Vec3 turn_rad =
      rotation_vector(multiply(state.to.tip_in_base.quaternion, conjugate(state.filter.pose.quaternion)));
  return smaller(share_left(governor.slow_ways, way_m), share_left(governor.slow_turns, turn_rad));
}

Twist tip_twist(const RobotParams& table, const MotionState& state) noexcept {
  Twist twist;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double rate = state.limiter.rate_rad_s[k];
    twist.linear_m_s = add(twist.linear_m_s, scale(state.arm.tip_jacobian.linear[k], rate));
    twist.angular_rad_s = add(twist.angular_rad_s, scale(state.arm.tip_jacobian.angular[k], rate));
  }
  return twist;
}

void reset_motion(const RobotParams& table, const ThetaVector& theta_rad, MotionState& state) noexcept {
  state = kNothing;
  state.ik_rad = theta_rad;
  state.governor.room_N.fill(kGovernorLeast_N * table.tension.scale());
  state.governor.accel_rad_s2.fill(kGovernorAlone * table.limits.theta_accel_rad_s2);
  reset_limiter(theta_rad, state.limiter);
  take_kinematics(table, state);
  state.filter.pose = state.arm.tip_in_base;
}

void accept_setpoint(const RobotParams& table, const Setpoint& setpoint, MotionState& state) noexcept {
  state.from = state.to;
  const bool begins = state.to.kind != setpoint.kind || state.braking;
  const std::uint32_t held_mask = is_tip(setpoint) ? setpoint.held_mask : 0u;
  if (begins && is_tip(setpoint)) {
    take_over(table, state);
    state.from = setpoint;
    state.from.tip_in_base = state.filter.pose;
  } else if (begins) {
    state.from = setpoint;
    state.from.joint_rad = state.limiter.theta_rad;
  }
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const bool newly_held = ((held_mask >> k) & 1u) != 0 && (begins || ((state.held_mask >> k) & 1u) == 0);
    if (newly_held) state.held[k] = HeldProfile{state.ik_rad[k], {{state.limiter.rate_rad_s[k], 0.0, 0.0}, {}}};
  }
  // A changed mask changes how thetas share the tip's motion. What they do now lives on as shape velocity, which goes
  // over smoothly.
  if (is_tip(setpoint) && held_mask != state.held_mask) state.shape.rate_rad_s = state.limiter.rate_rad_s;
  state.held_mask = held_mask;
  state.to = setpoint;
  state.turn_rad =
      rotation_vector(multiply(state.to.tip_in_base.quaternion, conjugate(state.from.tip_in_base.quaternion)));
  state.interval_tick = 0;
  state.braking = false;
}

void advance_motion(const RobotParams& table, const CableGeometry& geometry, bool allowed,
                    MotionState& state) noexcept {
  state.limits = 0;
  const bool braking = state.braking || !allowed, leads_tip = is_tip(state.to) && !braking;
  if (state.interval_tick < table.interval_ticks) ++state.interval_tick;
  FollowStep ik_step;
  if (braking) {
    brake(table, state);
  } else if (leads_tip) {
    ik_step = follow_tip(table, geometry, state);
  } else {
    follow_joints(table, state);
  }
  const double rate_share = state.to.kind == CommandKind::kRetract ? kRetractRateShare : 1.0;
  limit_motion(table, geometry, state.ik_rad, state.limiter, braking || leads_tip, rate_share);
  state.limits |= state.limiter.limits;
  take_kinematics(table, state);
  if (leads_tip) report_tip(table, ik_step, state);
  if (!braking) note_brake(table, state);
  if (!leads_tip) {
    state.filter = TipFilterState{};
    state.filter.pose = state.arm.tip_in_base;
  }
  state.shape.tick = state.shape.tick + 1 < kShapeTicks ? state.shape.tick + 1 : 0;
}

bool at_rest(const RobotParams& table, const MotionState& state) noexcept {
  const bool filter_rests = !is_tip(state.to) || at_rest(state.filter);
  return filter_rests && largest_rate(table, state.limiter) < 1e-6;
}

}  // namespace liana::cable
