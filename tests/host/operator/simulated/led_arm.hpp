// The cable arm as devices lead it: the clutch of the arbiter and the core's own motion, without drives, cables' give
// or verification. What a person at the devices meets, at a thousandth of the price of a bench.
#pragma once

#include <vector>

#include "firmware_like/cable/motion/motion.hpp"
#include "host/api/device/sample.hpp"
#include "host/control/arbiter/speed_zone.hpp"
#include "host/control/arbiter/teleop_input.hpp"

namespace liana::test {

class LedArm {
 public:
  LedArm(const cable::RobotParams& table, const cable::ThetaVector& theta_rad, const arbiter::SpeedZone& zone = {})
      : table_(table), layout_(cable::cable_layout(table)), zone_(zone) {
    cable::reset_motion(table_, theta_rad, motion_);
  }

  void use(const arbiter::DeviceUse& use) { steer_.use(use); }
  // These variables go to 0 and stay there, the tip where it is.
  void hold_at_zero(std::uint32_t mask) { held_mask_ = mask; }

  // One command interval with the samples that came in it.
  void interval(const std::vector<device::Sample>& samples) {
    for (const device::Sample& sample : samples) steer_.add(sample);
    const auto goal = steer_.finish_interval(outputs(), interval_s());
    if (goal || (held_mask_ != 0 && !motion_.held_at_target) || held_mask_ != asked_mask_) ask(goal);
    for (std::int32_t tick = 0; tick < table_.interval_ticks; ++tick) {
      const cable::CableGeometry geometry = cable::cable_geometry(table_, layout_, motion_.trig);
      cable::advance_motion(table_, geometry, goal.has_value() || !motion_.held_at_target, motion_);
      limits_ |= motion_.limits;
    }
  }

  double interval_s() const { return table_.tick_s * table_.interval_ticks; }
  bool held_at_target() const { return motion_.held_at_target; }
  std::int64_t made_of_us() const { return steer_.made_of_us(); }
  const cable::ThetaVector& theta_rad() const { return motion_.limiter.theta_rad; }
  const Pose& tip() const { return motion_.arm.tip_in_base; }
  Vec3 node_m(std::size_t node) const { return motion_.arm.node_in_base[node].position_m; }
  bool engaged() const { return steer_.engaged(); }
  // Of all ticks so far.
  std::uint32_t limits() const { return limits_; }

 private:
  void ask(const std::optional<arbiter::TeleopGoal>& goal) {
    cable::Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_in_base = goal ? goal->tip_in_base : motion_.arm.tip_in_base;
    if (goal) setpoint.node[0] = goal->node;
    setpoint.held_mask = asked_mask_ = held_mask_;
    const double asked_m_s = steer_.in_use().speed_m_s > 0.0 ? steer_.in_use().speed_m_s : table_.limits.tip_speed_m_s;
    setpoint.tip_speed_m_s =
        zone_.advice_at(tip().position_m, zone_.advice_at(setpoint.tip_in_base.position_m, asked_m_s));
    cable::accept_setpoint(table_, setpoint, motion_);
  }
  cable::Outputs outputs() const {
    cable::Outputs now{};
    now.tip_command = motion_.arm.tip_in_base;
    for (std::size_t m = 0; m < static_cast<std::size_t>(table_.segment_count); ++m)
      now.node_command_m[m] = motion_.arm.node_in_base[m + 1].position_m;
    return now;
  }

  cable::RobotParams table_;
  cable::CableLayout layout_;
  arbiter::SpeedZone zone_;
  arbiter::TeleopInput steer_;
  cable::MotionState motion_{};
  std::uint32_t held_mask_ = 0, asked_mask_ = 0;
  std::uint32_t limits_ = 0;
};

}  // namespace liana::test
