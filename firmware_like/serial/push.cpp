#include "firmware_like/serial/push.hpp"

#include <cmath>

#include "firmware_like/math/braking.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/serial/servo_ik.hpp"

namespace liana::serial {
namespace {

using Index = std::size_t;

// The tip of this tick, and the frames that forces are turned into.
struct Now {
  ArmKinematics arm;
  Vec3 axis;     // base frame
  Wrench given;  // by the arm, base frame
};

bool is_pushing(InsertPhase phase) noexcept { return phase != InsertPhase::kNone && phase != InsertPhase::kYielding; }

void enter(InsertPhase phase, InsertState& state) noexcept {
  state.phase = phase;
  state.phase_ticks = 0;
}

void end(InsertResult why, InsertState& state) noexcept {
  state.end = why;
  enter(InsertPhase::kYielding, state);
}

void begin(const RobotParams& table, const InsertInputs& in, InsertState& state) noexcept {
  const Push order = state.order;
  state = InsertState{};
  state.order = order;
  state.start = forward_kinematics(table, in.measured_rad).tip_in_base;
  state.adapter_spoke = is_heard(in.adapter) ? 1 : 0;
  enter(order.tares != 0 ? InsertPhase::kTaring : InsertPhase::kRelieving, state);
}

Now look(const RobotParams& table, const InsertInputs& in, const WristState& wrist, InsertState& state) noexcept {
  Now now{forward_kinematics(table, in.measured_rad), {}, {}};
  const Quat& attitude = now.arm.tip_in_base.quaternion;
  now.axis = rotate(attitude, state.order.axis_in_tip);
  state.given = given_by_arm(wrist);
  now.given = turned(attitude, state.given);
  const Vec3 way = subtract(now.arm.tip_in_base.position_m, state.start.position_m);
  state.travel_m = dot(way, rotate(state.start.quaternion, state.order.axis_in_tip));
  state.aside_m = norm(subtract(way, scale(rotate(state.start.quaternion, state.order.axis_in_tip), state.travel_m)));
  return now;
}

// The first joint that gives more than it may, or the tip; counted, since impacts are short.
bool is_overloaded(const RobotParams& table, const InsertInputs& in, InsertState& state) noexcept {
  const double force_N = norm(state.given.force_N);
  std::int16_t joint = -1;
  bool over = force_N > table.torque.most_force_N;
  double most = force_N;
  for (Index i = 0; i < table.joints() && !over; ++i) {
    over = std::fabs(in.torque_Nm[i]) > table.torque.most_joint_Nm;
    if (over) joint = narrow<std::int16_t>(i);
    if (over) most = std::fabs(in.torque_Nm[i]);
  }
  if (!over) {
    state.overload_ticks = 0;
  } else if (++state.overload_ticks >= kOverloadTicks) {
    state.overload_joint = joint;
    state.overload = most;
    return true;
  }
  return false;
}

InsertResult end_of(const RobotParams& table, const InsertInputs& in, const WristState& wrist, const Now& now,
                    InsertState& state) noexcept {
  if (!in.allowed) return InsertResult::kStopped;
  state.lost = health(wrist);
  if (state.lost != WristHealth::kGood) return InsertResult::kSensorLost;
  if (state.phase == InsertPhase::kTaring) return InsertResult::kNot;
  if (is_overloaded(table, in, state)) return InsertResult::kOverload;
  if (std::fabs(state.travel_m) > state.order.travel_m) return InsertResult::kTravel;
  const Quat turn = multiply(now.arm.tip_in_base.quaternion, conjugate(state.start.quaternion));
  if (state.aside_m > state.order.aside_m || norm(rotation_vector(turn)) > state.order.turn_rad)
    return InsertResult::kAside;
  if (state.phase == InsertPhase::kUnloading) return InsertResult::kNot;
  if (state.adapter_spoke != 0 && !is_heard(in.adapter)) return InsertResult::kAdapterSilent;
  if (says_captured(in.adapter) && !has_touched(state)) return InsertResult::kEarlyCapture;
  return InsertResult::kNot;
}

// The mean over kTareTicks; what is no bias makes no tare.
void tare(WristState& wrist, InsertState& state) noexcept {
  state.tare_sum = sum_of(state.tare_sum, wrist.felt);
  if (state.phase_ticks < kTareTicks) return;
  const Wrench mean = scaled(state.tare_sum, 1.0 / kTareTicks);
  if (norm(mean.force_N) > kMaxTare_N || norm(mean.torque_Nm) > kMaxTare_Nm) {
    state.lost = WristHealth::kNotAtRest;
    return end(InsertResult::kSensorLost, state);
  }
  wrist.tare = mean;
  enter(InsertPhase::kRelieving, state);
}

void relieve(InsertState& state) noexcept {
  const Vec3& axis = state.order.axis_in_tip;
  const Vec3 lateral_N = subtract(state.given.force_N, scale(axis, dot(axis, state.given.force_N)));
  const bool relieved = norm(lateral_N) < kRelieved_N && norm(state.given.torque_Nm) < kRelieved_Nm;
  state.relieved_ticks = relieved ? state.relieved_ticks + 1 : 0;
  if (state.relieved_ticks >= kRelievedTicks || state.phase_ticks >= kMaxRelievingTicks) {
    enter(InsertPhase::kPressing, state);
  }
}

// All of the force is for what resists, and for pins that are in. A pin that slips off an edge is free again: with all
// of the force it would meet the next wall twice as fast. And what a heavy payload on a base that swings lets the
// sensor feel is contact for none.
void feel(const Push& order, InsertState& state) noexcept {
  const double felt_N = dot(order.axis_in_tip, state.given.force_N);
  const bool feels_contact = felt_N > kContactShare * order.force_N;
  if (!has_touched(state)) state.touch_ticks = feels_contact ? narrow<std::uint16_t>(state.touch_ticks + 1) : 0;
  if (!feels_contact) {
    state.resist_ticks = 0;
  } else if (felt_N > kResistShare * order.force_N && state.resist_ticks < kResistTicks) {
    ++state.resist_ticks;
  }
}

void press(const RobotParams& table, const InsertInputs& in, InsertState& state) noexcept {
  const Push& order = state.order;
  feel(order, state);
  const bool takes_all = state.resist_ticks >= kResistTicks || pins_are_in(in.adapter);
  state.set_N = takes_all ? order.force_N : kApproachShare * order.force_N;
  const double pull_m = order.depth_m + order.force_N / order.gains[kStiffness];
  state.approach_m = smaller(pull_m, state.approach_m + order.gains[kApproachSpeed] * table.tick_s);
  if (!says_captured(in.adapter)) return;
  state.end = InsertResult::kCaptured;
  state.set_N = 0.0;
  enter(InsertPhase::kUnloading, state);
}

// Impedance pulls to a point on the axis and to the attitude that the push began with; from capture on both laws are
// one, without anything that is set.
Twist velocity_of(const RobotParams& table, const Now& now, const InsertState& state) noexcept {
  const bool unloads = state.phase == InsertPhase::kUnloading;
  const Push& order = state.order;
  LawInputs law{table.tick_s, now.axis, {scale(now.axis, state.set_N), {}}, now.given, {}, {}, 0.0};
  law.axial_damping = order.gains[unloads ? kUnloadDamping : kAxialDamping];
  const Pose& tip = now.arm.tip_in_base;
  const Vec3 pull =
      add(state.start.position_m, scale(rotate(state.start.quaternion, order.axis_in_tip), state.approach_m));
  law.away_m = subtract(pull, tip.position_m);
  law.away_rad = rotation_vector(multiply(state.start.quaternion, conjugate(tip.quaternion)));
  return law_step(unloads ? InsertLaw::kForce : order.law, order.gains, law, state.velocity);
}

// Rates that all joints can have, in the proportion that the tip needs; none goes past the end of its range.
JointVector bounded_rates(const RobotParams& table, const JointVector& measured_rad, JointVector rate) noexcept {
  double share = 1.0;
  for (Index i = 0; i < table.joints(); ++i) {
    const double size = std::fabs(rate[i]);
    if (size > table.joint[i].rate_rad_s) share = smaller(share, table.joint[i].rate_rad_s / size);
  }
  for (Index i = 0; i < table.joints(); ++i) {
    const JointParams& joint = table.joint[i];
    rate[i] *= share;
    const double room = rate[i] < 0.0 ? measured_rad[i] - joint.low_rad : joint.high_rad - measured_rad[i];
    rate[i] = rate_before_limit(rate[i], room, joint.accel_rad_s2, table.tick_s);
  }
  return rate;
}

// A gear that gives more than kFollowFrom_Nm is let go its way, against what it gives.
ForceMotion yield(const RobotParams& table, const InsertInputs& in) noexcept {
  ForceMotion motion;
  motion.holds_place = true;
  for (Index i = 0; i < table.joints(); ++i) {
    const double over_Nm = larger(0.0, std::fabs(in.torque_Nm[i]) - kFollowFrom_Nm);
    const double wanted = (in.torque_Nm[i] > 0.0 ? -over_Nm : over_Nm) / kFollow_Nm_per_rad_s;
    const double change = table.joint[i].accel_rad_s2 * table.tick_s;
    motion.rate_rad_s[i] = clamp(wanted, in.rate_rad_s[i] - change, in.rate_rad_s[i] + change);
  }
  motion.rate_rad_s = bounded_rates(table, in.measured_rad, motion.rate_rad_s);
  return motion;
}

}  // namespace

void accept_force(const Setpoint& setpoint, InsertState& state) noexcept {
  if (setpoint.kind == CommandKind::kFollow) {
    if (state.phase != InsertPhase::kYielding) end(InsertResult::kStopped, state);
    return;
  }
  const bool goes_on = state.phase != InsertPhase::kNone && state.order.number == setpoint.push.number;
  if (goes_on) return;
  state = InsertState{};
  state.order = setpoint.push;
  enter(InsertPhase::kTaring, state);
}

ForceMotion advance_force(const RobotParams& table, const InsertInputs& in, WristState& wrist,
                          InsertState& state) noexcept {
  if (is_pushing(state.phase) && state.phase_ticks == 0 && state.phase == InsertPhase::kTaring) begin(table, in, state);
  state.phase_ticks = narrow<std::uint32_t>(std::uint64_t{state.phase_ticks} + 1U);
  const Now now = look(table, in, wrist, state);
  if (is_pushing(state.phase)) {
    const InsertResult why = end_of(table, in, wrist, now, state);
    if (why != InsertResult::kNot) end(why, state);
  }
  state.set_N = 0.0;
  if (state.phase == InsertPhase::kTaring) tare(wrist, state);
  if (state.phase == InsertPhase::kRelieving) relieve(state);
  if (state.phase == InsertPhase::kPressing) press(table, in, state);
  if (state.phase == InsertPhase::kYielding) return yield(table, in);
  if (state.phase == InsertPhase::kTaring) return {{}, {}, true};
  state.velocity = velocity_of(table, now, state);
  const JointVector rate = rates_of_twist(table, now.arm.tip_jacobian, state.velocity);
  const double share = smaller(1.0, table.tick_s / kForwardFilter_s);
  state.forward = sum_of(scaled(state.forward, 1.0 - share), scaled(now.given, share));
  if (state.phase == InsertPhase::kUnloading) state.forward = {};
  return {bounded_rates(table, in.measured_rad, rate), torque_of_wrench(table, now.arm.tip_jacobian, state.forward),
          false};
}

}  // namespace liana::serial
