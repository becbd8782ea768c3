#include "host/operator/terminal/jog.hpp"

#include <gtest/gtest.h>

namespace liana::terminal {
namespace {

constexpr double kStep_s = 1.0 / 60.0;
constexpr JogLimits kLimits{0.1, 0.2};

TEST(Jog, MovesAlongTheBasesAxesOrTheTips) {
  const Pose turned{{1, 0, 0}, quaternion_of({0, 0, 1.5707963267948966})};  // its x axis is the base's y
  const Direction forward{{1, 0, 0}, {}};
  JogSpeed speed;
  const Pose in_base = next_goal(turned, turned, forward, speed, kStep_s, kLimits);
  EXPECT_NEAR(in_base.position_m[0], 1.0 + speed.tip_m_s * kStep_s, 1e-12);
  speed.in_tip = true;
  const Pose in_tip = next_goal(turned, turned, forward, speed, kStep_s, kLimits);
  EXPECT_NEAR(in_tip.position_m[0], 1.0, 1e-12);
  EXPECT_NEAR(in_tip.position_m[1], speed.tip_m_s * kStep_s, 1e-12);
}

// req:A24
TEST(Jog, AGoalNeverRunsAheadByMoreThanTheTipComesInThreeTenthsOfASecond) {
  const Pose still;
  for (const Direction& direction : {Direction{{1, 0, 0}, {}}, Direction{{1, 1, 1}, {}}, Direction{{}, {1, 1, 0}}}) {
    Pose goal = still;
    for (int k = 0; k < 600; ++k) goal = next_goal(goal, still, direction, {0.1, 0.2, false}, kStep_s, kLimits);
    EXPECT_LE(norm(goal.position_m), 0.03 + 1e-12);
    EXPECT_LE(norm(rotation_vector(goal.quaternion)), 0.06 + 1e-12);
    const Direction back{scale(direction.way, -1.0), scale(direction.turn, -1.0)};
    const Pose nearer = next_goal(goal, still, back, {0.1, 0.2, false}, kStep_s, kLimits);
    EXPECT_LT(norm(nearer.position_m) + norm(rotation_vector(nearer.quaternion)),
              norm(goal.position_m) + norm(rotation_vector(goal.quaternion)));
  }
}

TEST(Jog, ATerminalThatStoodStillDoesNotJump) {
  const Pose after = next_goal({}, {}, {{1, 0, 0}, {}}, {0.1, 0.2, false}, 100.0, kLimits);
  EXPECT_NEAR(after.position_m[0], 0.01, 1e-12);
}

TEST(HeldKeys, APressCountsForAWhileAndIsLengthenedByTheNext) {
  HeldKeys held;
  const Key forward = *key_of('w'), left = *key_of('a'), back = *key_of('s');
  EXPECT_FALSE(held.any(0.0));
  held.press(forward, 0.0);
  held.press(left, 0.1);
  EXPECT_EQ(held.direction(0.1).way, (Vec3{1, 1, 0}));
  EXPECT_EQ(held.direction(0.2).way, (Vec3{0, 1, 0}));
  held.press(left, 0.2);
  EXPECT_TRUE(held.any(0.3));
  EXPECT_FALSE(held.any(0.36));
  held.press(forward, 1.0);
  held.press(back, 1.0);
  EXPECT_EQ(held.direction(1.0).way, Vec3{});
  held.let_go();
  EXPECT_FALSE(held.any(1.0));
}

}  // namespace
}  // namespace liana::terminal
