#include "firmware_like/operator_input/tip_filter.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana {
namespace {

constexpr double kEnds_s = 0.1;  // at most about so long what speeds up goes on beyond a lowered speed limit

struct Saturated {
  Vec3 value;
  bool acted;
};

Saturated saturate(const Vec3& v, double limit) noexcept {
  const double length = norm(v);
  if (length <= limit) return {v, false};
  return {scale(v, limit / length), true};
}

// Velocity towards the wanted velocity within acceleration and jerk.
bool follow_velocity(const FilterBounds& bounds, double tick_s, const Vec3& wanted, ChannelState& state) noexcept {
  const double before = norm(state.velocity);
  const Vec3 ahead = before > 0.0 ? scale(state.velocity, 1.0 / before) : Vec3{};
  const double rises = dot(ahead, state.acceleration);
  const double k2 = bounds.jerk / bounds.accel;
  const double k3 = 4.0 * k2;
  const Saturated a = saturate(scale(subtract(wanted, state.velocity), k2), bounds.accel);
  const double gain = k3 * tick_s < 1.0 ? k3 : 1.0 / tick_s;
  const Saturated jerk = saturate(scale(subtract(a.value, state.acceleration), gain), bounds.jerk);
  state.acceleration = add(state.acceleration, scale(jerk.value, tick_s));
  double allowed = bounds.speed;  // the discrete steps may overshoot it by a rounding
  if (before > bounds.speed) {
    // Coming from a higher speed limit, the filter brakes down to the new one, and what speeds up still ends that
    // first.
    const double most = larger(0.0, rises - tick_s * larger(bounds.jerk, rises / kEnds_s));
    const double over = dot(ahead, state.acceleration) - most;
    if (over > 0.0) state.acceleration = subtract(state.acceleration, scale(ahead, over));
    allowed = before + most * tick_s;
  }
  state.velocity = saturate(add(state.velocity, scale(state.acceleration, tick_s)), allowed).value;
  return a.acted;
}

double pull_1_s(const FilterBounds& bounds) noexcept {
  return bounds.pull_1_s > 0.0 ? bounds.pull_1_s : bounds.accel / bounds.speed;
}

// How far the target comes in the lead: it is not believed to go on faster than the tip may follow.
Vec3 ahead(const FilterBounds& bounds, const Vec3& target_velocity) noexcept {
  return scale(saturate(target_velocity, bounds.speed).value, bounds.lead_s);
}

// Takes the outward part of a channel's velocity away as far as the leash says; returns what was taken.
Vec3 taken_back(double free, double most, const Vec3& lead, ChannelState& channel) noexcept {
  const double far = norm(lead);
  if (far <= free) return {};
  const Vec3 outward = scale(lead, 1.0 / far);
  const double speed = dot(channel.velocity, outward), accel = dot(channel.acceleration, outward);
  if (speed <= 0.0) return {};
  const Vec3 taken = scale(outward, speed * smaller(1.0, (far - free) / (most - free)));
  channel.velocity = subtract(channel.velocity, taken);
  if (accel > 0.0) channel.acceleration = subtract(channel.acceleration, scale(outward, accel));
  return taken;
}

Vec3 along_axes(const SlowDirections& slow, const Vec3& v) noexcept {
  return {dot(slow.axis[0], v), dot(slow.axis[1], v), dot(slow.axis[2], v)};
}

Vec3 from_axes(const SlowDirections& slow, const Vec3& along) noexcept {
  return add(add(scale(slow.axis[0], along[0]), scale(slow.axis[1], along[1])), scale(slow.axis[2], along[2]));
}

// One tick of a channel that moves, along the axes, as if no direction were slow, and of whose motion each direction
// has its share. How slow a direction is changes with the pose: what is faster comes nearer to its share by as much as
// may be braked in a tick.
ChannelLimits follow_slowed(const FilterBounds& bounds, const SlowDirections* directions, double tick_s,
                            const Vec3& error, ChannelState& state) noexcept {
  if (directions == nullptr || is_even(*directions)) return follow_channel(bounds, tick_s, error, state);
  const SlowDirections& slow = *directions;
  ChannelState even{along_axes(slow, state.velocity), along_axes(slow, state.acceleration)};
  // What a slow direction lacks counts in full where its share of the speed makes up for it, and beside the others no
  // more than what the speed is full with.
  Vec3 lacking = along_axes(slow, error);
  const double full = bounds.speed / pull_1_s(bounds);
  for (std::size_t i = 0; i < 3; ++i) {
    if (slow.share[i] == 1.0) continue;
    const double most = larger(full, std::fabs(lacking[i]));
    lacking[i] = clamp(lacking[i] / slow.share[i], -most, most);
    const double allowed = larger(slow.share[i] * bounds.speed, std::fabs(even.velocity[i]) - bounds.accel * tick_s);
    even.velocity[i] = clamp(even.velocity[i], -allowed, allowed) / slow.share[i];
    even.acceleration[i] = clamp(even.acceleration[i] / slow.share[i], -bounds.accel, bounds.accel);
  }
  const ChannelLimits limits = follow_channel(bounds, tick_s, lacking, even);
  for (std::size_t i = 0; i < 3; ++i) {
    even.velocity[i] *= slow.share[i];
    even.acceleration[i] *= slow.share[i];
  }
  state = {from_axes(slow, even.velocity), from_axes(slow, even.acceleration)};
  return limits;
}

// Integrates both channels into the pose.
void move_pose(double tick_s, TipFilterState& state) noexcept {
  state.pose.position_m = add(state.pose.position_m, scale(state.linear.velocity, tick_s));
  state.pose.quaternion =
      normalize(multiply(quaternion_of(scale(state.angular.velocity, tick_s)), state.pose.quaternion));
}

}  // namespace

ChannelLimits follow_channel(const FilterBounds& bounds, double tick_s, const Vec3& error,
                             ChannelState& state) noexcept {
  const Saturated wanted = saturate(scale(error, pull_1_s(bounds)), bounds.speed);
  return {wanted.acted, follow_velocity(bounds, tick_s, wanted.value, state)};
}

bool brake_channel(const FilterBounds& bounds, double tick_s, ChannelState& state) noexcept {
  // From this acceleration the jerk limit ends both together: a^2 = 2 jerk v. A little less leaves room for the steps.
  constexpr double kJerkShare = 0.9;
  const double speed = norm(state.velocity);
  const double ending = std::sqrt(2.0 * kJerkShare * bounds.jerk * speed);
  const bool limited = ending > bounds.accel;
  const double wanted = limited ? bounds.accel : ending;
  const Vec3 acceleration = speed > 0.0 ? scale(state.velocity, -wanted / speed) : Vec3{};
  const Saturated change = saturate(subtract(acceleration, state.acceleration), bounds.jerk * tick_s);
  state.acceleration = add(state.acceleration, change.value);
  state.velocity = add(state.velocity, scale(state.acceleration, tick_s));
  if (norm(state.velocity) < 0.5 * bounds.accel * tick_s) state = ChannelState{};
  return limited;
}

double lag_s(const FilterBounds& bounds) noexcept { return 1.0 / pull_1_s(bounds) - bounds.lead_s; }

double min_lag_s(const FilterBounds& bounds) noexcept {
  return 0.5 * bounds.speed / bounds.accel + 0.25 * bounds.accel / bounds.jerk;
}

FilterBounds with_lag(const FilterBounds& bounds, double lag_s, double speed) noexcept {
  FilterBounds out = bounds;
  out.speed = speed;
  if (lag_s <= 0.0) return out;
  const double slowest_s = bounds.speed / bounds.accel;
  out.pull_1_s = 1.0 / larger(lag_s, slowest_s);
  out.lead_s = larger(0.0, slowest_s - lag_s);
  return out;
}

void filter_tip(const TipFilterConfig& config, const Pose& target, TipFilterState& state) noexcept {
  if (!is_valid(target)) {
    brake_tip(config, state);
    return;
  }
  const SteadyTarget aim = without_tremor(target, config.tick_s, state.tremor);
  const Vec3 behind_m = subtract(aim.pose.position_m, state.pose.position_m);
  const Vec3 behind_rad = rotation_vector(multiply(aim.pose.quaternion, conjugate(state.pose.quaternion)));
  const Vec3 position_error = add(behind_m, ahead(config.linear, aim.velocity_m_s));
  const Vec3 attitude_error = add(behind_rad, ahead(config.angular, aim.rate_rad_s));
  const ChannelLimits linear =
      follow_slowed(config.linear, config.slow_ways, config.tick_s, position_error, state.linear);
  const ChannelLimits angular =
      follow_slowed(config.angular, config.slow_turns, config.tick_s, attitude_error, state.angular);
  state.speed_limited = linear.speed || angular.speed;
  state.accel_limited = linear.accel || angular.accel;
  move_pose(config.tick_s, state);
}

void hold_back(const Leash& leash, const std::array<double, 6>& lead, double tick_s, TipFilterState& state) noexcept {
  const Vec3 move = taken_back(leash.free_m, leash.most_m, {lead[0], lead[1], lead[2]}, state.linear);
  const Vec3 turn = taken_back(leash.free_rad, leash.max_rad, {lead[3], lead[4], lead[5]}, state.angular);
  state.pose.position_m = subtract(state.pose.position_m, scale(move, tick_s));
  if (dot(turn, turn) > 0.0)
    state.pose.quaternion = normalize(multiply(quaternion_of(scale(turn, -tick_s)), state.pose.quaternion));
}

void brake_tip(const TipFilterConfig& config, TipFilterState& state) noexcept {
  state.speed_limited = false;
  state.tremor = TremorState{};
  const bool linear = brake_channel(config.linear, config.tick_s, state.linear);
  const bool angular = brake_channel(config.angular, config.tick_s, state.angular);
  state.accel_limited = linear || angular;
  move_pose(config.tick_s, state);
}

bool at_rest(const TipFilterState& state) noexcept {
  return dot(state.linear.velocity, state.linear.velocity) < 1e-12 &&
         dot(state.angular.velocity, state.angular.velocity) < 1e-12;
}

}  // namespace liana
