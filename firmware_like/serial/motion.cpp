#include "firmware_like/serial/motion.hpp"

#include "firmware_like/math/scalar.hpp"
#include "firmware_like/safety/limits.hpp"

namespace liana::serial {
namespace {

using Index = std::size_t;

constexpr double kBehind =
    1e-4;  // m and rad: from here the target does not wait, or a blocked arm could not be led away

bool is_tip(const Setpoint& setpoint) noexcept { return setpoint.kind == CommandKind::kTip; }

TipFilterConfig filter_config(const RobotParams& table, double tip_speed_m_s) noexcept {
  const TipLimits& tip = table.tip;
  return {{smaller(tip_speed_m_s, tip.speed_m_s), tip.accel_m_s2, tip.jerk_m_s3},
          {tip.rate_rad_s, tip.angular_accel_rad_s2, tip.angular_jerk_rad_s3},
          table.tick_s};
}

double interval_share(const RobotParams& table, const MotionState& state) noexcept {
  return liana::interval_share(state.interval_tick, table.interval_ticks);
}

Pose interpolated_target(const RobotParams& table, const MotionState& state) noexcept {
  return interpolated_pose(state.from.tip_in_base, state.to.tip_in_base, state.turn_rad, interval_share(table, state));
}

// Takes only a share of this tick's motion, of the target as of the joints: the arm slows down on its path and does not
// leave it.
void slow_down(const RobotParams& table, double share, const Pose& target_before, const JointVector& ik_before,
               MotionState& state) noexcept {
  if (state.ik.position_error_m + state.ik.attitude_error_rad < kBehind)
    slow_filter(target_before, share, state.filter);
  for (Index i = 0; i < table.joints(); ++i) state.ik_rad[i] = ik_before[i] + share * (state.ik_rad[i] - ik_before[i]);
  const IkResult now = report_ik(table, state.filter.pose, forward_kinematics(table, state.ik_rad).tip_in_base);
  const IkOutcome before = state.ik.outcome;
  state.ik.residual = now.residual;
  state.ik.position_error_m = now.position_error_m;
  state.ik.attitude_error_rad = now.attitude_error_rad;
  if (before == IkOutcome::kConverged) state.ik.outcome = now.outcome;
}

// The wish of joints that the tip leaves free to choose among: towards the middle of their ranges, as fast as the tip
// moves.
JointVector centring_wish(const RobotParams& table, const MotionState& state) noexcept {
  const double moving = smaller(1.0, norm(state.filter.linear.velocity) / table.tip.speed_m_s +
                                         norm(state.filter.angular.velocity) / table.tip.rate_rad_s);
  JointVector wish{};
  for (Index i = 0; i < table.joints(); ++i) {
    const JointParams& joint = table.joint[i];
    const double middle = 0.5 * (joint.low_rad + joint.high_rad), half = 0.5 * (joint.high_rad - joint.low_rad);
    wish[i] = -kCentringShare * moving * joint.rate_rad_s * table.tick_s * (state.ik_rad[i] - middle) / half;
  }
  return wish;
}

void follow_tip(const RobotParams& table, bool braking, MotionState& state) noexcept {
  const Pose target_before = state.filter.pose;
  const JointVector ik_before = state.ik_rad;
  const TipFilterConfig config = filter_config(table, state.to.tip_speed_m_s);
  if (braking) {
    brake_tip(config, state.filter);
  } else {
    filter_tip(config, interpolated_target(table, state), state.filter);
  }
  if (state.filter.speed_limited) state.limits |= kLimitTipSpeed;
  if (state.filter.accel_limited) state.limits |= kLimitTipAccel;
  state.ik = servo_ik(table, state.filter.pose, centring_wish(table, state), state.ik_rad);
  if (state.ik.limit_mask != 0) state.limits |= kLimitTheta;
  if (state.ik.outcome == IkOutcome::kSingular) state.limits |= kLimitSingular;
  if (state.ik.outcome == IkOutcome::kUnreachable) state.limits |= kLimitReach;

  JointVector step{};
  for (Index i = 0; i < table.joints(); ++i) step[i] = state.ik_rad[i] - ik_before[i];
  const StepShare allowed = allowed_share(table, step, state.limiter);
  state.limits |= allowed.limits;
  if (allowed.share < 1.0) slow_down(table, allowed.share, target_before, ik_before, state);
}

// Linear over the command interval; the limiter does the rest.
void follow_joints(const RobotParams& table, MotionState& state) noexcept {
  const double share = interval_share(table, state);
  for (Index i = 0; i < table.joints(); ++i) {
    state.ik_rad[i] = state.from.joint_rad[i] + share * (state.to.joint_rad[i] - state.from.joint_rad[i]);
  }
}

void brake_joints(const RobotParams& table, MotionState& state) noexcept {
  state.ik_rad = braked_joints(table, state.limiter);
  state.limiter.reference_rad = state.limiter.joint_rad;  // what was left to go is given up
}

// From joint motion: takes over pose and velocity of the tip.
void start_filter(const RobotParams& table, MotionState& state) noexcept {
  const Twist tip = tip_twist(table, state.arm.tip_jacobian, state.limiter.rate_rad_s);
  state.ik_rad = state.limiter.joint_rad;
  state.filter = TipFilterState{};
  state.filter.pose = state.arm.tip_in_base;
  state.filter.linear.velocity = tip.linear_m_s;
  state.filter.angular.velocity = tip.angular_rad_s;
}

}  // namespace

void reset_motion(const RobotParams& table, const JointVector& joint_rad, MotionState& state) noexcept {
  state = MotionState{};
  state.ik_rad = joint_rad;
  reset_limiter(joint_rad, state.limiter);
  state.arm = forward_kinematics(table, joint_rad);
  state.filter.pose = state.arm.tip_in_base;
}

void accept_setpoint(const RobotParams& table, const Setpoint& setpoint, MotionState& state) noexcept {
  const bool same_kind = setpoint.kind == state.to.kind && !state.braking;
  state.from = same_kind ? state.to : setpoint;
  if (is_tip(setpoint) && !same_kind) {
    if (!is_tip(state.to)) start_filter(table, state);
    state.from.tip_in_base = state.filter.pose;
  }
  if (!is_tip(setpoint) && !same_kind) state.from.joint_rad = state.limiter.joint_rad;
  state.to = setpoint;
  state.turn_rad =
      rotation_vector(multiply(state.to.tip_in_base.quaternion, conjugate(state.from.tip_in_base.quaternion)));
  state.interval_tick = 0;
  state.braking = false;
}

void advance_motion(const RobotParams& table, bool allowed, MotionState& state) noexcept {
  state.limits = 0;
  const bool braking = state.braking || !allowed;
  if (state.interval_tick < table.interval_ticks) ++state.interval_tick;
  if (is_tip(state.to)) {
    follow_tip(table, braking, state);
  } else if (braking) {
    brake_joints(table, state);
  } else {
    follow_joints(table, state);
  }
  limit_motion(table, state.ik_rad, state.limiter, state.to.kind == CommandKind::kRetract ? kRetractRateShare : 1.0);
  state.limits |= state.limiter.limits;
  state.arm = forward_kinematics(table, state.limiter.joint_rad);
}

bool at_rest(const RobotParams& table, const MotionState& state) noexcept {
  const bool filter_rests = !is_tip(state.to) || liana::at_rest(state.filter);
  return filter_rests && largest_rate(table, state.limiter) < 1e-6;
}

}  // namespace liana::serial
