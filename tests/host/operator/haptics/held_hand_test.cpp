// The simulated hand on the simulated device: it goes where the person wants, and gives way to a force.
#include "host/operator/haptics/held_hand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace liana::haptics {
namespace {

constexpr double kTurn_rad = 0.6;

HandParams steady() {
  HandParams hand;
  hand.stiffness_N_m = 500.0;
  hand.reaction_s = 0.0;
  hand.tremor_m = 0.0;
  return hand;
}

device::Sample wish(int k, const Vec3& position_m, const Quat& attitude = {1.0, 0.0, 0.0, 0.0}) {
  return {.t_us = 1000 * k, .deadman = true, .pose = {position_m, attitude}};
}

TEST(HeldHand, GoesWhereThePersonWants) {
  HeldHand held({}, steady(), 1);
  const Vec3 there{0.03, -0.02, 0.04};
  device::Sample sensed;
  for (int k = 1; k <= 4000; ++k) sensed = held.step(wish(k, scale(there, std::min(1.0, k / 2000.0))), {});
  EXPECT_LT(norm(subtract(sensed.pose.position_m, there)), 2e-5);
  EXPECT_EQ(sensed.t_us, 4000000);
  EXPECT_TRUE(sensed.deadman);
}

TEST(HeldHand, TurnsItsWristAsThePersonWants) {
  HeldHand held({}, steady(), 1);
  for (const Vec3& axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}, Vec3{0.6, -0.48, 0.64}}) {
    const Quat attitude = quaternion_of(scale(axis, kTurn_rad));
    held.step(wish(1, {}, attitude), {});
    const device::Sample sensed = held.step(wish(2, {}, attitude), {});
    const Vec3 off = rotation_vector(multiply(sensed.pose.quaternion, conjugate(attitude)));
    EXPECT_LT(norm(off), 1e-9);
  }
}

// A tip that is held back pulls the hand back, in the same direction of the base frame, and no way else.
TEST(HeldHand, IsPulledTowardsATipThatIsHeldBack) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    HeldHand held({}, steady(), 1);
    Vec3 ahead{};
    ahead[axis] = 0.02;
    device::Sample sensed;
    for (int k = 1; k <= 3000; ++k) {
      held.loop().predict(1000 * k, {ahead, {}});
      if (k % 20 == 0) held.loop().take(StatePacket{static_cast<std::uint32_t>(k), 1000 * k, 0, {}});
      sensed = held.step(wish(k, {}), ahead);
    }
    Vec3 expected{};
    expected[axis] = -200.0 * 0.02 / 500.0;  // K dp against the hand's own stiffness
    EXPECT_LT(norm(subtract(sensed.pose.position_m, expected)), 3e-4) << axis;
    EXPECT_NEAR(held.peak_force_N(), 4.0, 0.1);
    EXPECT_LT(held.min_energy_J(), 0.0);
    EXPECT_GT(held.min_energy_J(), -0.1);
  }
}

TEST(HeldHand, FeelsLessAtALargerScale) {
  HeldHand held({}, steady(), 1);
  held.loop().scale_by(4.0);
  for (int k = 1; k <= 2000; ++k) {
    held.loop().predict(1000 * k, {{0.02, 0.0, 0.0}, {}});
    if (k % 20 == 0) held.loop().take(StatePacket{static_cast<std::uint32_t>(k), 1000 * k, 0, {}});
    held.step(wish(k, {}), {});
  }
  EXPECT_NEAR(held.peak_force_N(), 1.0, 0.05);
}

}  // namespace
}  // namespace liana::haptics
