#include "host/control/server/device_state.hpp"

#include <algorithm>
#include <cmath>

namespace liana::server {

namespace {

// A driver that misses five states in a row hears nothing any more.
constexpr double kWatchdogIntervals = 5.0;

void fill(const Vec3& from, double (&to)[3]) { std::copy(from.begin(), from.end(), to); }

liana_plane plane_of(const haptics::Plane& plane) {
  liana_plane out{};
  fill(plane.normal, out.normal);
  out.offset_m = plane.offset_m;
  out.stiffness_N_m = plane.stiffness_N_m;
  out.damping_N_s_m = plane.damping_N_s_m;
  return out;
}

liana_twist twist(const Pose& from, const Pose& to, double time_s) {
  liana_twist out{};
  fill(scale(subtract(to.position_m, from.position_m), 1.0 / time_s), out.linear_m_s);
  const Vec3 turn_rad = rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
  fill(scale(turn_rad, 1.0 / time_s), out.angular_rad_s);
  return out;
}

}  // namespace

void DeviceState::note_release(std::uint64_t first_tick, std::int64_t made_of_us) { next_ = {first_tick, made_of_us}; }

void DeviceState::look(const ArmForDevices& arm, double tick_s) {
  if (next_.first_tick <= arm.tick) in_force_ = next_;
  liana_state& out = common_ = device::make<liana_state>(LIANA_STATE);
  out.tick = arm.tick;
  out.arm_time_us = arm.arm_time_us;
  out.watchdog_s = kWatchdogIntervals * interval_s_;
  if (arm.is_enabled) out.flags |= LIANA_ENABLED;
  out.present = LIANA_HAS_MEASURED | LIANA_HAS_SETPOINT;
  out.measured_cp = device::pose_of(arm.measured_tip);
  if (before_) out.measured_cv = twist(*before_, arm.measured_tip, interval_s_);
  before_ = arm.measured_tip;
  out.setpoint_cp = device::pose_of(arm.commanded_tip);
  if (arm.predicted_tip) {
    out.present |= LIANA_HAS_PREDICTED;
    out.predicted_cp = device::pose_of(*arm.predicted_tip);
  }
  if (arm.clearance_m) {
    out.present |= LIANA_HAS_CLEARANCE;
    out.clearance_m = *arm.clearance_m;
  }
  planes_ = arm.planes;
  out.answers_us = -1;
  if (in_force_.of_us >= 0)
    out.held_us = std::llround(static_cast<double>(arm.tick - in_force_.first_tick) * tick_s * 1e6);
}

// What a hand is to feel (wrench, reference, walls) is told to the device in use alone.
liana_state DeviceState::state_for(const arbiter::TeleopInput* steer) const {
  liana_state out = common_;
  out.scale = out.rotation_scale = 1.0;
  if (steer == nullptr) return out;
  out.flags |= LIANA_IN_USE;
  if (steer->engaged()) out.flags |= LIANA_ENGAGED;
  out.answers_us = in_force_.of_us;
  std::string_view(steer->reason()).copy(out.reason, sizeof out.reason - 1);
  out.scale = steer->in_use().mapping.scale;
  out.rotation_scale = steer->in_use().mapping.rotation_scale;
  static_assert(virtual_fixtures::kMaxPlanes == LIANA_MAX_PLANES);
  out.planes = LIANA_MAX_PLANES;
  std::transform(planes_.begin(), planes_.end(), out.plane, plane_of);
  return out;
}

}  // namespace liana::server
