// Clutch: P_r = a P_m from the anchors, and never a jump on engaging.
#include "host/control/arbiter/clutch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "firmware_like/math/trig.hpp"

namespace liana::arbiter {

namespace {

const Pose kTip{{1.0, -0.5, 0.3}, normalize({0.9, 0.1, -0.3, 0.2})};
const Pose kHand{{0.02, 0.03, -0.01}, normalize({0.8, -0.2, 0.5, 0.1})};

// One step of a hand that engaged at kHand, with the tip where it is told to be.
Pose goal_of(const ClutchMapping& mapping, const Pose& tip, const Pose& hand) {
  Clutch clutch;
  clutch.engage(kHand, tip);
  return clutch.follow(mapping, hand, tip);
}

double turn_between(const Quat& a, const Quat& b) { return norm(rotation_vector(multiply(a, conjugate(b)))); }

// req:A27
TEST(Clutch, EngagingNeverMovesTheGoal) {
  for (const double scale : {0.2, 1.0, 4.0}) {
    const Pose goal = goal_of({scale, 0.7}, kTip, kHand);
    EXPECT_EQ(goal.position_m, kTip.position_m);
    EXPECT_NEAR(turn_between(goal.quaternion, kTip.quaternion), 0.0, 1e-15);
  }
}

// req:A28 req:C4
TEST(Clutch, TranslationIsScaledAndParallel) {
  Pose hand = kHand;
  hand.position_m = add(hand.position_m, {0.01, -0.02, 0.03});
  const Pose goal = goal_of({4.0, 1.0}, kTip, hand);
  EXPECT_NEAR(goal.position_m[0] - kTip.position_m[0], 0.04, 1e-15);
  EXPECT_NEAR(goal.position_m[1] - kTip.position_m[1], -0.08, 1e-15);
  EXPECT_NEAR(goal.position_m[2] - kTip.position_m[2], 0.12, 1e-15);
}

// req:A28 req:C4
TEST(Clutch, RotationIsScaledAboutTheSameAxis) {
  Pose hand = kHand;
  hand.quaternion = multiply(quaternion_of({0.0, 0.2, 0.0}), kHand.quaternion);
  const Pose goal = goal_of({1.0, 0.5}, kTip, hand);
  const Vec3 turn = rotation_vector(multiply(goal.quaternion, conjugate(kTip.quaternion)));
  EXPECT_NEAR(turn[0], 0.0, 1e-12);
  EXPECT_NEAR(turn[1], 0.1, 1e-12);
  EXPECT_NEAR(turn[2], 0.0, 1e-12);
  EXPECT_NEAR(turn_between(goal_of({1.0, 0.0}, kTip, hand).quaternion, kTip.quaternion), 0.0, 1e-12)
      << "scale 0 locks attitude";
}

// The tip looks along the base's y: what the hand does along its x the tip does along y, and turns follow.
TEST(Clutch, InTheTipsFrameTheHandsAxesAreThoseOfTheTipOnEngaging) {
  const Pose tip{{1.0, 0.0, 0.0}, quaternion_of({0.0, 0.0, 0.5 * kPi})};
  const Pose hand{add(kHand.position_m, {0.01, 0.0, 0.0}), multiply(quaternion_of({0.2, 0.0, 0.0}), kHand.quaternion)};
  const Pose goal = goal_of({4.0, 0.5, TeleopFrame::kTip}, tip, hand);
  EXPECT_NEAR(norm(subtract(goal.position_m, {1.0, 0.04, 0.0})), 0.0, 1e-15);
  const Vec3 turn = rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion)));
  EXPECT_NEAR(norm(subtract(turn, {0.0, 0.1, 0.0})), 0.0, 1e-12);
}

// The tip is turned by a quarter about z, half of what the hand does, and then led along the hand's x.
TEST(Clutch, InTheCamerasFrameTheAxesTurnAlongWithTheTip) {
  for (const auto& [frame, way] :
       {std::pair{TeleopFrame::kTip, Vec3{0.02, 0.0, 0.0}}, std::pair{TeleopFrame::kCamera, Vec3{0.0, 0.02, 0.0}}}) {
    const ClutchMapping mapping{2.0, 0.5, frame};
    Clutch clutch;
    clutch.engage({}, {});
    Pose hand, goal;
    for (int i = 1; i <= 100; ++i) {
      hand.quaternion = quaternion_of({0.0, 0.0, 0.01 * i * kPi});
      goal = clutch.follow(mapping, hand, goal);
    }
    hand.position_m = {0.01, 0.0, 0.0};
    goal = clutch.follow(mapping, hand, goal);
    EXPECT_NEAR(norm(subtract(goal.position_m, way)), 0.0, 1e-12);
  }
}

// Where the tip has turned to about x, counted from where it was [rad]; each call less than half a turn further on.
struct CountedTurn {
  double rad = 0.0;
  Quat at = kTip.quaternion;
  void add(const Quat& now) {
    rad += rotation_vector(multiply(now, conjugate(at)))[0];
    at = now;
  }
};

// req:C4
TEST(Clutch, AHandThatTurnsOnAndOnTurnsTheTipOnAndOn) {
  for (const TeleopFrame frame : {TeleopFrame::kBase, TeleopFrame::kTip, TeleopFrame::kCamera}) {
    for (const double rotation_scale : {0.05, 0.2, 1.0, 3.0}) {
      const Pose tip{kTip.position_m, {1.0, 0.0, 0.0, 0.0}};
      Clutch clutch;
      clutch.engage(kHand, tip);
      CountedTurn turned{.at = tip.quaternion};
      Pose hand = kHand;
      for (int i = 1; i <= 1000; ++i) {  // 20 rad, and back by 25
        const double hand_rad = i <= 500 ? 0.04 * i : 20.0 - 0.05 * (i - 500);
        hand.quaternion = multiply(quaternion_of({std::fmod(hand_rad, 2.0 * kPi), 0.0, 0.0}), kHand.quaternion);
        turned.add(clutch.follow({1.0, rotation_scale, frame}, hand, {tip.position_m, turned.at}).quaternion);
        ASSERT_NEAR(turned.rad, rotation_scale * hand_rad, 1e-9) << rotation_scale << ", " << i;
      }
    }
  }
}

// A tip that is slow: what is asked for leads it by less than half a turn, and it comes to where the hand has turned.
TEST(Clutch, AGoalLeadsTheTipByAQuarterTurnAtMostAndItComesAllTheWay) {
  for (const double sign : {-1.0, 1.0}) {
    Clutch clutch;
    Pose tip{kTip.position_m, {1.0, 0.0, 0.0, 0.0}}, hand = kHand;
    clutch.engage(kHand, tip);
    CountedTurn turned{.at = tip.quaternion};
    for (int i = 1; i <= 2000; ++i) {
      const double hand_rad = sign * std::min(0.02 * i, 4.5);  // 1 rad/s, the tip comes after at 0.2 rad/s
      hand.quaternion = multiply(quaternion_of({hand_rad, 0.0, 0.0}), kHand.quaternion);
      const Pose goal = clutch.follow({}, hand, tip);
      const Vec3 ahead = rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion)));
      ASSERT_LE(norm(ahead), kMaxLead_rad + 1e-9) << i;
      ASSERT_GE(sign * ahead[0], -1e-9) << "never the other way round";
      const double step_rad = std::min(norm(ahead), 0.004);
      tip.quaternion = multiply(quaternion_of({std::copysign(step_rad, ahead[0]), 0.0, 0.0}), tip.quaternion);
      turned.add(tip.quaternion);
    }
    EXPECT_NEAR(turned.rad, sign * 4.5, 1e-6);
  }
}

// Leading by all that is allowed, the hand turns back: so does the tip, after what was owed.
TEST(Clutch, AHandThatTurnsBackTakesBackWhatTheTipHasNotDone) {
  Clutch clutch;
  Pose hand = kHand;
  clutch.engage(kHand, kTip);
  const auto lead_rad = [&](double hand_rad) {
    hand.quaternion = multiply(quaternion_of({hand_rad, 0.0, 0.0}), kHand.quaternion);
    const Pose goal = clutch.follow({}, hand, kTip);
    return rotation_vector(multiply(goal.quaternion, conjugate(kTip.quaternion)))[0];
  };
  for (int i = 1; i <= 100; ++i) lead_rad(0.03 * i);
  EXPECT_NEAR(lead_rad(3.0), kMaxLead_rad, 1e-9);
  for (int i = 1; i <= 90; ++i) lead_rad(3.0 - 0.03 * i);
  EXPECT_NEAR(lead_rad(0.3), 0.3, 1e-9);
}

// req:A27
TEST(Clutch, ReindexingAddsUpWhatTheHandDidWhileEngaged) {
  Pose tip = kTip;
  for (int stroke = 0; stroke < 3; ++stroke) {
    Pose end = kHand;
    end.position_m[0] += 0.05;
    tip = goal_of({2.0, 1.0}, tip, end);
  }
  EXPECT_NEAR(tip.position_m[0], kTip.position_m[0] + 0.30, 1e-12);
}

}  // namespace
}  // namespace liana::arbiter
