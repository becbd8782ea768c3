// What the damping is for: without friction nothing stops a swing of such an arm (physics study, section 4).
#include <gtest/gtest.h>

#include <algorithm>

#include "arm_under_control.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr double kWindow_s = 3.0;  // longer than the slowest period, 2 s

// A kick that reaches every mode.
cable::ThetaVector kick() {
  cable::ThetaVector rate{};
  for (std::size_t i = 0; i < 10; ++i) rate[i] = (i % 3 == 0 ? 0.3 : -0.15) * kDegree;
  return rate;
}

// Energy of the motion [J]: over whole swings, kinetic energy is half of it.
double motion_energy_J(ArmUnderControl& arm) {
  double sum = 0.0;
  int count = 0;
  for (double t = 0.0; t < kWindow_s; t += arm.table().tick_s) {
    arm.step();
    sum += arm.plant().kinetic_energy_J();
    ++count;
  }
  return 2.0 * sum / count;
}

// Share of the kick's energy left 10 s later.
double share_left_after_kick(bool enabled) {
  ArmUnderControl arm({"ideal", 1, false, "prepare"});
  if (enabled) arm.boot();
  arm.wait(5.0);
  arm.plant().kick(kick());
  const double start_J = arm.plant().kinetic_energy_J();
  arm.wait(10.0 - 0.5 * kWindow_s);
  EXPECT_EQ(arm.outputs().faults.count, 0);
  return motion_energy_J(arm) / start_J;
}

TEST(Damping, TakesTheEnergyOfAKickOutWithinTenSeconds) {
  const double left = share_left_after_kick(true);
  measured("energy of a kick left after 10 s, enabled and holding", 100.0 * left, "%");
  EXPECT_LT(left, 0.05);
}

TEST(Damping, IsNeededBecauseWithMotorsHeldTheSwingStays) {
  const double left = share_left_after_kick(false);
  measured("energy of a kick left after 10 s, motors held", 100.0 * left, "%");
  EXPECT_GT(left, 0.50);
}

class Holding : public ::testing::TestWithParam<const char*> {};

// Noise of the torque readings keeps the arm alive a little; what must not happen is that it grows.
TEST_P(Holding, NothingGrowsInAMinuteAfterAMotion) {
  ArmUnderControl arm({GetParam(), 1, true, "prepare"});
  arm.boot();
  arm.move_joints(named_pose_rad("panel_edge"), 25.0);
  double first_J = 0.0, last_J = 0.0, tip_mm = 0.0;
  Vec3 tip_m{};
  for (int second = 0; second < 60; ++second) {
    double largest_J = 0.0;
    arm.hold(1.0, [&](ArmUnderControl& now) { largest_J = std::max(largest_J, now.plant().kinetic_energy_J()); });
    if (second < 10) first_J = std::max(first_J, largest_J);
    if (second == 50) tip_m = arm.plant().tip_in_base().position_m;
    if (second >= 50) last_J = std::max(last_J, largest_J);
    if (second >= 50) tip_mm = std::max(tip_mm, distance_mm(arm.plant().tip_in_base().position_m, tip_m));
  }
  measured(std::string(GetParam()) + ": largest kinetic energy, first 10 s", 1e6 * first_J, "uJ");
  measured(std::string(GetParam()) + ": largest kinetic energy, last 10 s of 60", 1e6 * last_J, "uJ");
  measured(std::string(GetParam()) + ": tip drift in the last 10 s", tip_mm, "mm");
  EXPECT_LT(last_J, first_J);
  EXPECT_LT(tip_mm, 1.0);
  EXPECT_EQ(arm.outputs().state, OperatingState::kEnabled);
}

INSTANTIATE_TEST_SUITE_P(Physics, Holding, ::testing::Values("ideal", "nominal"));

}  // namespace
}  // namespace liana::closed_loop
