// A tension reading that is lost, in the middle of a motion: fault 5001, and the arm stops along its path and holds.
#include <gtest/gtest.h>

#include <algorithm>

#include "arm_under_control.hpp"
#include "firmware_like/math/trig.hpp"
#include "firmware_like/safety/faults.hpp"
#include "firmware_like/safety/watchdogs.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr std::size_t kCable = 7;

// Under way from prepare to panel edge, at about the highest speed.
void get_under_way(ArmUnderControl& arm) {
  arm.boot();
  const ThetaVector from = arm.outputs().theta_command_rad;
  const ThetaVector to = named_pose_rad("panel_edge");
  arm.follow(12.0, [&](double share) {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    for (std::size_t i = 0; i < 10; ++i) setpoint.joint_rad[i] = from[i] + minimum_jerk(0.5 * share) * (to[i] - from[i]);
    return setpoint;
  });
}

TEST(CableFault, ALostTensionReadingIsFault5001WithinItsDebounceAndTheArmStops) {
  ArmUnderControl arm({"nominal", 1, true, "prepare"});
  get_under_way(arm);
  ASSERT_EQ(arm.outputs().faults.count, 0);
  ASSERT_EQ(arm.outputs().at_rest, 0);
  arm.lose_tension_reading(kCable);
  int ticks = 0;
  while (arm.outputs().faults.count == 0 && ticks < 1000) {
    arm.step();
    ++ticks;
  }
  ASSERT_EQ(arm.outputs().faults.count, 1);
  measured("ticks from the lost reading to the fault", ticks, "");
  EXPECT_EQ(arm.outputs().faults.fault[0].number, FaultNumber::kCableSlack);
  EXPECT_EQ(arm.outputs().faults.fault[0].index, static_cast<std::int16_t>(kCable));
  EXPECT_GE(ticks, kSlackDebounceTicks) << "a stick-slip dip must not stop the arm";
  EXPECT_LE(ticks, kSlackDebounceTicks + 1);

  arm.wait(2.0);
  EXPECT_EQ(arm.outputs().state, OperatingState::kEnabled) << "a hold: tension is kept";
  EXPECT_EQ(arm.outputs().stop_category, StopCategory::kHold);
  EXPECT_EQ(arm.outputs().at_rest, 1);
  const ThetaVector held = arm.outputs().theta_command_rad;
  arm.hold(2.0);
  EXPECT_EQ(arm.outputs().theta_command_rad, held) << "no telecommand moves an arm in fault";
}

// The damping believes the reading that is lost; its limit, 0.3 deg at the motors, is what bounds that.
TEST(CableFault, ALostTensionReadingOfAnArmAtRestHardlyMovesIt) {
  ArmUnderControl arm({"nominal", 1, true, "prepare"});
  arm.boot();
  arm.hold(5.0);
  const ThetaVector before = arm.plant().theta_rad();
  const Vec3 tip_before_m = arm.plant().tip_in_base().position_m;
  arm.lose_tension_reading(kCable);
  double largest_deg = 0.0, largest_mm = 0.0;
  arm.hold(20.0, [&](ArmUnderControl& now) {
    largest_deg = std::max(largest_deg, largest_difference_deg(now.plant().theta_rad(), before));
    largest_mm = std::max(largest_mm, distance_mm(now.plant().tip_in_base().position_m, tip_before_m));
  });
  measured("lost reading at rest: largest joint motion in 20 s", largest_deg, "deg");
  measured("lost reading at rest: largest tip motion in 20 s", largest_mm, "mm");
  EXPECT_LT(largest_deg, kDampingLimit_rad / kDegree);
  EXPECT_NE(arm.outputs().state, OperatingState::kEnabled) << "a fault that persists ends in brakes";
}

}  // namespace
}  // namespace liana::closed_loop
