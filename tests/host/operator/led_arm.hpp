// The cable arm as VR handles lead it: the clutch of the arbiter and the core's own motion, without drives, cables'
// give or verification. What a person at the handles meets, at a thousandth of the price of a bench.
#pragma once

#include <vector>

#include "firmware_like/cable/motion/motion.hpp"
#include "host/arbiter/device_steer.hpp"
#include "host/operator/samples.hpp"

namespace liana::test {

class LedArm {
 public:
  LedArm(const cable::RobotTable& table, const cable::ThetaVector& theta_rad, const arbiter::DeviceUse& use)
      : table_(table), layout_(cable::cable_layout(table)), use_(use) {
    cable::reset_motion(table_, theta_rad, motion_);
    steer_.use(use);
  }

  // One command interval with the samples that came in it.
  void interval(const std::vector<operator_side::BothHands>& samples) {
    for (const operator_side::BothHands& both : samples) {
      steer_.add(both.right);
      steer_.add(both.left);
    }
    const double interval_s = table_.tick_s * table_.interval_ticks;
    const auto goal = steer_.finish_interval(outputs(), interval_s);
    if (goal) {
      cable::Setpoint setpoint;
      setpoint.kind = CommandKind::kTip;
      setpoint.tip_in_base = goal->tip_in_base;
      setpoint.node[0] = goal->node;
      setpoint.tip_speed_m_s = use_.speed_m_s;
      cable::accept_setpoint(table_, setpoint, motion_);
    }
    for (std::int32_t tick = 0; tick < table_.interval_ticks; ++tick) {
      const cable::CableGeometry geometry = cable::cable_geometry(table_, layout_, motion_.trig);
      cable::advance_motion(table_, geometry, goal.has_value(), motion_);
      limits_ |= motion_.limits;
    }
  }

  const cable::ThetaVector& theta_rad() const { return motion_.limiter.theta_rad; }
  const Pose& tip() const { return motion_.arm.tip_in_base; }
  Vec3 node_m(std::size_t node) const { return motion_.arm.node_in_base[node].position_m; }
  bool engaged() const { return steer_.engaged(); }
  // Of all ticks so far.
  std::uint32_t limits() const { return limits_; }

 private:
  cable::Outputs outputs() const {
    cable::Outputs now{};
    now.tip_command = motion_.arm.tip_in_base;
    for (std::size_t m = 0; m < static_cast<std::size_t>(table_.segment_count); ++m)
      now.node_command_m[m] = motion_.arm.node_in_base[m + 1].position_m;
    return now;
  }

  cable::RobotTable table_;
  cable::CableLayout layout_;
  arbiter::DeviceUse use_;
  arbiter::DeviceSteer steer_;
  cable::MotionState motion_{};
  std::uint32_t limits_ = 0;
};

}  // namespace liana::test
