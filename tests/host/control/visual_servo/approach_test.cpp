#include "host/control/visual_servo/approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace liana::visual_servo {
namespace {

constexpr double kStep_s = 0.02;
const Pose kApproached{{2.0, -1.0, 0.5}, quaternion_of({0.3, 0.2, -0.5})};

TEST(Approach, TheSpeedThatCanBeBrakedFromMeetsTheLawWithoutAStep) {
  const double k = 0.45, accel = 0.005, meet = accel / (k * k);
  EXPECT_NEAR(approach_speed(meet * (1 - 1e-9), k, accel, 1.0), approach_speed(meet * (1 + 1e-9), k, accel, 1.0), 1e-9);
  EXPECT_DOUBLE_EQ(approach_speed(0.001, k, accel, 1.0), 0.00045);
  EXPECT_DOUBLE_EQ(approach_speed(0.5, k, accel, 0.028), 0.028);
}

TEST(Approach, ErrorsAreToldInTheTargetsAxes) {
  Pose tip = kApproached;
  tip.position_m = add(kApproached.position_m, rotate(kApproached.quaternion, {-0.1, 0.02, 0.0}));
  tip.quaternion = multiply(kApproached.quaternion, quaternion_of({0.0, 0.0, -0.01}));
  const PoseError error = error_between(kApproached, kApproached, tip);
  EXPECT_NEAR(error.m[0], 0.1, 1e-12);
  EXPECT_NEAR(error.m[1], -0.02, 1e-12);
  EXPECT_NEAR(error.rad[2], 0.01, 1e-12);
}

// A tip that does at once what is asked for, from `off` of the target, in its axes.
struct Walk {
  double duration_s = 0.0, axial_m_s = 0.0, lateral_m_s = 0.0, rate_rad_s = 0.0, accel_m_s2 = 0.0, overshoot_m = 0.0;
  PoseError left{};
};

Walk walk(const Vec3& off_m, const Vec3& off_rad) {
  const ApproachLimits limits;
  Approach approach(limits);
  Pose tip{add(kApproached.position_m, rotate(kApproached.quaternion, off_m)),
           multiply(kApproached.quaternion, quaternion_of(off_rad))};
  approach.begin(tip);
  Walk out;
  Vec3 velocity{};
  for (out.left = error_between(kApproached, kApproached, tip); norm(out.left.m) + norm(out.left.rad) > 1e-4;) {
    tip = approach.next(kApproached, kApproached, tip, tip, kStep_s);
    const PoseError left = error_between(kApproached, kApproached, tip);
    const Vec3 now = scale(subtract(out.left.m, left.m), 1.0 / kStep_s);
    out.axial_m_s = std::max(out.axial_m_s, std::fabs(now[0]));
    out.lateral_m_s = std::max(out.lateral_m_s, std::hypot(now[1], now[2]));
    out.rate_rad_s = std::max(out.rate_rad_s, norm(subtract(out.left.rad, left.rad)) / kStep_s);
    out.accel_m_s2 = std::max(out.accel_m_s2, norm(subtract(now, velocity)) / kStep_s);
    for (std::size_t i = 0; i < 3; ++i)
      if (left.m[i] * off_m[i] > 0.0) out.overshoot_m = std::max(out.overshoot_m, std::fabs(left.m[i]));
    velocity = now;
    out.left = left;
    out.duration_s += kStep_s;
    if (out.duration_s > 100.0) break;
  }
  return out;
}

TEST(Approach, StaysWithinEveryLimitAndComesToTheGoalWithoutPassingIt) {
  const Walk way = walk({-0.53, 0.015, 0.02}, {0.0087, -0.007, 0.0105});
  EXPECT_LT(way.duration_s, 45.0);
  EXPECT_LE(way.axial_m_s, 0.028 + 1e-9);
  EXPECT_LE(way.lateral_m_s, 0.008 + 1e-9);
  EXPECT_LE(way.rate_rad_s, 0.00873 + 1e-6);
  EXPECT_LE(way.accel_m_s2, 0.005 * 1.02);
  EXPECT_LT(way.overshoot_m, 1e-6);
}

TEST(Approach, TheWayInIsTheAxisThatIsNamed) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ApproachLimits limits;
    limits.axis = axis;
    Approach approach(limits);
    approach.begin(kApproached);
    Pose goal = kApproached, tip = kApproached;
    goal.position_m = add(kApproached.position_m, rotate(kApproached.quaternion, {1.0, 1.0, 1.0}));
    for (int i = 0; i < 1000; ++i) tip = approach.next(kApproached, goal, kApproached, tip, kStep_s);
    const Pose next = approach.next(kApproached, goal, kApproached, tip, kStep_s);
    const Vec3 now =
        rotate(conjugate(kApproached.quaternion), scale(subtract(next.position_m, tip.position_m), 1 / kStep_s));
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(now[i], i == axis ? limits.speed_m_s : limits.lateral_speed_m_s / std::sqrt(2.0), 1e-9);
  }
}

TEST(Approach, ALagOfWhatFollowsIsNoOvershoot) {
  const ApproachLimits limits;
  Approach approach(limits);
  Pose tip{add(kApproached.position_m, rotate(kApproached.quaternion, {-0.5, 0.0, 0.0})), kApproached.quaternion};
  approach.begin(tip);
  double past_m = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Pose goal = approach.next(kApproached, kApproached, tip, tip, kStep_s);
    tip.position_m = add(tip.position_m, scale(subtract(goal.position_m, tip.position_m), kStep_s / 1.0));
    past_m = std::max(past_m, -error_between(kApproached, kApproached, tip).m[0]);
  }
  EXPECT_LT(past_m, 2e-4);
  EXPECT_LT(norm(error_between(kApproached, kApproached, tip).m), 1e-5);
}

TEST(Approach, AnErrorThatTheCommandDoesNotKnowOfIsTakenOut) {
  Approach approach((ApproachLimits()));
  Pose command = kApproached;
  const Vec3 sag{0.0, 0.004, -0.003};  // measured beside the command
  approach.begin(command);
  Pose measured;
  for (int i = 0; i < 3000; ++i) {
    measured = {add(command.position_m, sag), command.quaternion};
    command = approach.next(kApproached, kApproached, measured, command, kStep_s);
  }
  EXPECT_LT(norm(error_between(kApproached, kApproached, measured).m), 1e-5);
}

TEST(Approach, BrakesToRestWithinItsAcceleration) {
  Approach approach((ApproachLimits()));
  Pose tip{add(kApproached.position_m, rotate(kApproached.quaternion, {-0.5, 0.0, 0.0})), kApproached.quaternion};
  approach.begin(tip);
  for (int i = 0; i < 500; ++i) tip = approach.next(kApproached, kApproached, tip, tip, kStep_s);
  const Vec3 from = tip.position_m;
  Pose before = tip;
  for (int i = 0; i < 300; ++i) {
    before = tip;
    tip = approach.brake(kStep_s);
  }
  EXPECT_EQ(norm(subtract(tip.position_m, before.position_m)), 0.0);
  EXPECT_NEAR(norm(subtract(tip.position_m, from)), 0.028 * 0.028 / (2 * 0.005), 0.002);
}

}  // namespace
}  // namespace liana::visual_servo
