// Clutch: P_r = a P_m from the anchors, and never a jump on engaging.
#include "host/arbiter/clutch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "firmware_like/math/trig.hpp"

namespace liana::arbiter {

namespace {

const Pose kTip{{1.0, -0.5, 0.3}, normalize({0.9, 0.1, -0.3, 0.2})};
const Pose kHand{{0.02, 0.03, -0.01}, normalize({0.8, -0.2, 0.5, 0.1})};

double turn_between(const Quat& a, const Quat& b) { return norm(rotation_vector(multiply(a, conjugate(b)))); }

// req:A27
TEST(Clutch, EngagingNeverMovesTheGoal) {
  for (const double scale : {0.2, 1.0, 4.0}) {
    const Pose goal = clutch_goal({scale, 0.7}, {kHand, kTip}, kHand);
    EXPECT_EQ(goal.position_m, kTip.position_m);
    EXPECT_NEAR(turn_between(goal.quaternion, kTip.quaternion), 0.0, 1e-15);
  }
}

// req:A28 req:C4
TEST(Clutch, TranslationIsScaledAndParallel) {
  Pose hand = kHand;
  hand.position_m = add(hand.position_m, {0.01, -0.02, 0.03});
  const Pose goal = clutch_goal({4.0, 1.0}, {kHand, kTip}, hand);
  EXPECT_NEAR(goal.position_m[0] - kTip.position_m[0], 0.04, 1e-15);
  EXPECT_NEAR(goal.position_m[1] - kTip.position_m[1], -0.08, 1e-15);
  EXPECT_NEAR(goal.position_m[2] - kTip.position_m[2], 0.12, 1e-15);
}

// req:A28 req:C4
TEST(Clutch, RotationIsScaledAboutTheSameAxis) {
  Pose hand = kHand;
  hand.quaternion = multiply(quaternion_of({0.0, 0.2, 0.0}), kHand.quaternion);
  const Pose goal = clutch_goal({1.0, 0.5}, {kHand, kTip}, hand);
  const Vec3 turn = rotation_vector(multiply(goal.quaternion, conjugate(kTip.quaternion)));
  EXPECT_NEAR(turn[0], 0.0, 1e-12);
  EXPECT_NEAR(turn[1], 0.1, 1e-12);
  EXPECT_NEAR(turn[2], 0.0, 1e-12);
  EXPECT_NEAR(turn_between(clutch_goal({1.0, 0.0}, {kHand, kTip}, hand).quaternion, kTip.quaternion), 0.0, 1e-12)
      << "scale 0 locks attitude";
}

// The tip looks along the base's y: what the hand does along its x the tip does along y, and turns follow.
TEST(Clutch, InTheTipsFrameTheHandsAxesAreThoseOfTheTipOnEngaging) {
  const Pose tip{{1.0, 0.0, 0.0}, quaternion_of({0.0, 0.0, 0.5 * kPi})};
  const Pose hand{add(kHand.position_m, {0.01, 0.0, 0.0}), multiply(quaternion_of({0.2, 0.0, 0.0}), kHand.quaternion)};
  const Pose goal = clutch_goal({4.0, 0.5, SteerFrame::kTip}, {kHand, tip}, hand);
  EXPECT_NEAR(norm(subtract(goal.position_m, {1.0, 0.04, 0.0})), 0.0, 1e-15);
  const Vec3 turn = rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion)));
  EXPECT_NEAR(norm(subtract(turn, {0.0, 0.1, 0.0})), 0.0, 1e-12);
}

// The tip is turned by a quarter about z, half of what the hand does, and then led along the hand's x.
TEST(Clutch, InTheCamerasFrameTheAxesTurnAlongWithTheTip) {
  for (const auto& [frame, way] :
       {std::pair{SteerFrame::kTip, Vec3{0.02, 0.0, 0.0}}, std::pair{SteerFrame::kCamera, Vec3{0.0, 0.02, 0.0}}}) {
    const ClutchMapping mapping{2.0, 0.5, frame};
    ClutchAnchor anchor{Pose{}, Pose{}};
    Pose hand, goal;
    for (int i = 1; i <= 100; ++i) {
      hand.quaternion = quaternion_of({0.0, 0.0, 0.01 * i * kPi});
      goal = clutch_goal(mapping, anchor, hand);
      move_anchor(mapping, hand, goal, anchor);
    }
    hand.position_m = {0.01, 0.0, 0.0};
    goal = clutch_goal(mapping, anchor, hand);
    EXPECT_NEAR(norm(subtract(goal.position_m, way)), 0.0, 1e-12);
  }
}

// req:A27
TEST(Clutch, ReindexingAddsUpWhatTheHandDidWhileEngaged) {
  Pose tip = kTip;
  for (int stroke = 0; stroke < 3; ++stroke) {
    Pose end = kHand;
    end.position_m[0] += 0.05;
    tip = clutch_goal({2.0, 1.0}, {kHand, tip}, end);
  }
  EXPECT_NEAR(tip.position_m[0], kTip.position_m[0] + 0.30, 1e-12);
}

}  // namespace
}  // namespace liana::arbiter
