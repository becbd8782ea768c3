#include "hand_to_tip.hpp"

#include <algorithm>
#include <functional>

#include "fixture.hpp"

namespace liana::closed_loop {

using namespace cable;

namespace {

constexpr double kStand_s = 4.0;
constexpr double kSwing_s = 2.0;  // the slowest mode's period

// Way of the hand [m] after so many seconds.
using Hand = std::function<double(double)>;

Setpoint goal_at(const Pose& tip, const Led& led) {
  Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  setpoint.tip_in_base = tip;
  setpoint.tip_speed_m_s = led.limit_m_s;
  setpoint.held_mask = led.held_mask;
  return setpoint;
}

RobotParams table_with(const std::string& physics, const MotionLimits& limits) {
  RobotParams table = robot_table(physics);
  table.limits = limits;
  return table;
}

// Leads the tip by `hand` for so many seconds; `look` gets the hand's way and the true tip's at every tick.
Following lead(ArmUnderControl& arm, const Led& led, const Hand& hand, double seconds,
               const std::function<void(double t_s, double hand_m, double tip_m)>& look) {
  const Pose from = arm.outputs().tip_command;
  const double tick_s = arm.table().tick_s, late_s = kHandToGoal_intervals * tick_s * arm.table().interval_ticks;
  const Vec3 standing_m = subtract(arm.plant().tip_in_base().position_m, from.position_m);
  Following out;
  double t_s = 0.0;
  arm.plant().take_load();
  arm.follow(
      seconds,
      [&](double share) {
        Pose goal = from;
        goal.position_m = add(goal.position_m, scale(led.direction, hand(share * seconds - late_s)));
        return goal_at(goal, led);
      },
      [&](ArmUnderControl& now) {
        t_s += tick_s;
        const Vec3 tip_m = subtract(now.plant().tip_in_base().position_m, standing_m);
        out.swing_mm = std::max(out.swing_mm, distance_mm(tip_m, now.outputs().tip_command.position_m));
        look(t_s, hand(t_s), dot(subtract(tip_m, from.position_m), led.direction));
      });
  out.least_N = arm.plant().take_load().least_N;
  out.faults = arm.outputs().faults.count;
  return out;
}

}  // namespace

ArmToLead::ArmToLead(const PlantSetup& setup, const MotionLimits& limits)
    : ArmUnderControl(setup, table_with(setup.physics, limits)) {}

void ArmToLead::settle(const Led& led) {
  boot();
  move_joints(named_pose_rad(led.pose), 3.0);
  const Pose tip = outputs().tip_command;
  follow(kStand_s, [&](double) { return goal_at(tip, led); });
}

Following follow_steadily(ArmUnderControl& arm, const Led& led, double speed_m_s) {
  constexpr double kSeconds = 5.0;
  double behind_m = 0.0;
  std::int32_t ticks = 0;
  const Hand hand = [&](double t_s) {  // the integral of a smooth step
    const double t = std::clamp(t_s, 0.0, 1.0);
    return speed_m_s * (t * t * t * (1.0 - 0.5 * t) + std::max(0.0, t_s - 1.0));
  };
  Following out = lead(arm, led, hand, kSeconds, [&](double t_s, double hand_m, double tip_m) {
    if (t_s <= kSeconds - kSwing_s) return;
    behind_m += hand_m - tip_m;
    ++ticks;
  });
  out.lag_s = behind_m / ticks / speed_m_s;
  return out;
}

Following follow_reach(ArmUnderControl& arm, const Led& led, double way_m, double seconds) {
  double farthest_m = 0.0;
  const Hand hand = [&](double t_s) { return way_m * minimum_jerk(std::clamp(t_s / seconds, 0.0, 1.0)); };
  Following out = lead(arm, led, hand, seconds + kStand_s,
                       [&](double, double, double tip_m) { farthest_m = std::max(farthest_m, tip_m); });
  out.overshoot_mm = 1000.0 * (farthest_m - way_m);
  return out;
}

}  // namespace liana::closed_loop
