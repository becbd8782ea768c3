// Operator filter (req:A16): whatever comes in, velocity, acceleration and jerk stay bounded, and the lag is the stated
// one.
#include "firmware_like/cable/motion/motion.hpp"

#include <gtest/gtest.h>

#include "firmware_like/math/scalar.hpp"
#include "firmware_like/math/trig.hpp"
#include "tests/firmware_like/extremes.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

constexpr double kWithRounding = 1.0 + 1e-9;

TipFilterConfig config_of(const RobotParams& robot) { return tip_filter_config(robot, 0.0); }
TipFilterConfig config() { return config_of(zhu2022::table()); }

// Checks one channel of one tick against its bounds; says which one broke.
void expect_bounded(const FilterBounds& bounds, double tick_s, const ChannelState& before, const ChannelState& now) {
  ASSERT_LE(norm(now.velocity), bounds.speed * kWithRounding);
  ASSERT_LE(norm(now.acceleration), bounds.accel * kWithRounding);
  ASSERT_LE(norm(subtract(now.velocity, before.velocity)), bounds.accel * tick_s * kWithRounding);
  ASSERT_LE(norm(subtract(now.acceleration, before.acceleration)), bounds.jerk * tick_s * kWithRounding);
}

// One tick towards `target`, with every bound checked, on the state and on the pose that comes out.
void step(const Pose& target, TipFilterState& state) {
  const TipFilterConfig with = config();
  const TipFilterState before = state;
  filter_tip(with, target, state);
  ASSERT_TRUE(is_valid(state.pose));
  expect_bounded(with.linear, with.tick_s, before.linear, state.linear);
  expect_bounded(with.angular, with.tick_s, before.angular, state.angular);
  const double moved_m = norm(subtract(state.pose.position_m, before.pose.position_m));
  const double turned = norm(rotation_vector(multiply(state.pose.quaternion, conjugate(before.pose.quaternion))));
  ASSERT_LE(moved_m, with.linear.speed * with.tick_s * kWithRounding);
  ASSERT_LE(turned, with.angular.speed * with.tick_s * kWithRounding);
}

Pose random_pose(Random& random, double range_m) { return {random.vector(range_m), quaternion_of(random.vector(1.5))}; }

TEST(TipFilter, RandomTargetsNeverPassTheBounds) {
  Random random(1);
  TipFilterState state;
  Pose target;
  for (std::int32_t i = 0; i < 40000; ++i) {
    if (i % 150 == 0) target = random_pose(random, i % 300 == 0 ? 5.0 : 0.02);
    step(target, state);
    if (HasFatalFailure()) return;
  }
}

TEST(TipFilter, GlitchesAndNoiseNeverPassTheBounds) {
  Random random(2);
  TipFilterState state;
  for (std::int32_t i = 0; i < 20000; ++i) {
    Pose target{{0.0004 * i, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    target.position_m = add(target.position_m, random.vector(0.005));
    if (i % 97 == 0) target.position_m[1] = 1e6;  // a jump of one sample
    step(target, state);
    if (HasFatalFailure()) return;
  }
}

TEST(TipFilter, WhatIsNotAPoseMakesItBrakeAndStand) {
  for (const double bad : {kNan, kInf, -kInf}) {
    TipFilterState state;
    const Pose far{{2.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    for (std::int32_t i = 0; i < 500; ++i) filter_tip(config(), far, state);
    ASSERT_GT(norm(state.linear.velocity), 0.05);
    Pose broken = far;
    broken.position_m[2] = bad;
    for (std::int32_t i = 0; i < 500; ++i) {
      filter_tip(config(), broken, state);
      ASSERT_TRUE(is_valid(state.pose));
    }
    EXPECT_TRUE(at_rest(state));
    broken = far;
    broken.quaternion = {bad, 0.0, 0.0, 0.0};
    const Pose stood = state.pose;
    filter_tip(config(), broken, state);
    EXPECT_EQ(state.pose.position_m, stood.position_m);
  }
}

TEST(TipFilter, AStepIsReachedWithoutOvershoot) {
  for (const double size_m : {0.0002, 0.005, 0.05, 0.5, 2.0}) {
    TipFilterState state;
    const Pose target{{size_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    for (std::int32_t i = 0; i < 10000; ++i) {
      step(target, state);
      if (HasFatalFailure()) return;
      ASSERT_LE(state.pose.position_m[0], size_m * (1.0 + 1e-3)) << size_m;
    }
    EXPECT_NEAR(state.pose.position_m[0], size_m, 1e-6) << size_m;
    EXPECT_TRUE(at_rest(state));
  }
}

TEST(TipFilter, ATurnIsReachedWithoutOvershoot) {
  for (const double angle : {0.01, 0.5, 3.0}) {
    TipFilterState state;
    const Pose target{{0.0, 0.0, 0.0}, quaternion_of({0.0, 0.0, angle})};
    for (std::int32_t i = 0; i < 10000; ++i) {
      step(target, state);
      if (HasFatalFailure()) return;
      ASSERT_LE(rotation_vector(state.pose.quaternion)[2], angle * (1.0 + 1e-3)) << angle;
    }
    EXPECT_NEAR(rotation_vector(state.pose.quaternion)[2], angle, 1e-6) << angle;
  }
}

// A robot whose table says how late its tip is; room to brake is there from 0.2275 s on.
RobotParams with_tip_lag(double lag_s) {
  RobotParams robot = zhu2022::table();
  robot.limits.tip_accel_m_s2 = 0.25;
  robot.limits.tip_jerk_m_s3 = 2.5;
  robot.limits.tip_angular_accel_rad_s2 = 50.0 * kDegree;
  robot.limits.tip_angular_jerk_rad_s3 = 500.0 * kDegree;
  robot.limits.tip_lag_s = lag_s;
  return robot;
}

// How far behind a steady target tip and attitude are [s]; `speed` is a share of the speed limits.
struct Lags {
  double linear_s, angular_s;
};
Lags lags_behind_a_ramp(const TipFilterConfig& with, double speed) {
  const double speed_m_s = speed * with.linear.speed, rate_rad_s = speed * with.angular.speed;
  TipFilterState state;
  double t_s = 0.0;
  while (t_s < 5.0) {
    t_s += with.tick_s;
    filter_tip(with, {{speed_m_s * t_s, 0.0, 0.0}, quaternion_of({0.0, rate_rad_s * t_s, 0.0})}, state);
  }
  return {t_s - state.pose.position_m[0] / speed_m_s, t_s - rotation_vector(state.pose.quaternion)[1] / rate_rad_s};
}

TEST(TipFilter, LagBehindARampIsTheStatedOne) {
  const TipFilterConfig with = config();
  const Lags lags = lags_behind_a_ramp(with, 0.5);
  EXPECT_NEAR(lags.linear_s, lag_s(with.linear) + kTremorLag_s, 1.5 * with.tick_s);
  EXPECT_NEAR(lag_s(with.linear), 0.5, 1e-12);
}

TEST(TipFilter, ALagInTheTableIsThatOfTipAndAttitudeAtEverySpeedAndSpeedLimit) {
  for (const double lag_in_table_s : {0.23, 0.25, 0.6}) {
    const RobotParams robot = with_tip_lag(lag_in_table_s);
    for (const double limit_m_s : {0.1, 0.03}) {
      const TipFilterConfig with = tip_filter_config(robot, limit_m_s);
      EXPECT_NEAR(lag_s(with.linear), lag_in_table_s, 1e-12);
      for (const double speed : {0.2, 0.9}) {
        const Lags lags = lags_behind_a_ramp(with, speed);
        EXPECT_NEAR(lags.linear_s, lag_in_table_s + kTremorLag_s, 1.5 * with.tick_s) << limit_m_s << " " << speed;
        EXPECT_NEAR(lags.angular_s, lag_in_table_s + kTremorLag_s, 1.5 * with.tick_s) << limit_m_s << " " << speed;
      }
    }
  }
}

// The shortest lag that a table may have leaves room to brake; three quarters of it do not.
TEST(TipFilter, ATargetThatStopsDeadIsNotPassedFromTheShortestLagOn) {
  const FilterBounds bounds = config_of(with_tip_lag(0.0)).linear;
  for (const double share : {1.0, 0.75}) {
    const TipFilterConfig with = config_of(with_tip_lag(share * min_lag_s(bounds)));
    TipFilterState state;
    double target_m = 0.0, farthest_m = 0.0;
    for (std::int32_t i = 0; i < 3000; ++i) {
      if (i < 1500) target_m += bounds.speed * smaller(1.0, i / 500.0) * with.tick_s;
      filter_tip(with, {{target_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, state);
      farthest_m = larger(farthest_m, state.pose.position_m[0]);
    }
    if (share == 1.0) {
      EXPECT_LT(farthest_m, target_m + 0.005 * bounds.speed);
    } else {
      EXPECT_GT(farthest_m, target_m + 0.02 * bounds.speed);
    }
  }
}

// What a hand does when it starts, stops and starts again: the target is where the filter stands, and nothing jumps.
TEST(TipFilter, AfterBrakingItGoesOnFromWhereItIsWithoutAKick) {
  const TipFilterConfig with = config_of(with_tip_lag(0.25));
  TipFilterState state;
  for (std::int32_t i = 0; i < 300; ++i) filter_tip(with, {{0.0003 * i, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, state);
  ASSERT_GT(norm(state.linear.velocity), 0.05);
  for (std::int32_t i = 0; i < 400; ++i) brake_tip(with, state);
  ASSERT_TRUE(at_rest(state));
  const Pose stood = state.pose;
  for (std::int32_t i = 0; i < 400; ++i) {
    filter_tip(with, stood, state);
    ASSERT_EQ(state.pose.position_m, stood.position_m) << i;
  }
}

TEST(TipFilter, BrakingComesToRestWithinABoundedNumberOfTicks) {
  constexpr std::int32_t kMaxTicks = 400;  // 1.6 s from full speed
  TipFilterState state;
  const Pose far{{50.0, -20.0, 5.0}, quaternion_of({0.0, 3.0, 0.0})};
  for (std::int32_t i = 0; i < 500; ++i) step(far, state);
  const TipFilterConfig with = config();
  ASSERT_GT(norm(state.linear.velocity), 0.99 * with.linear.speed);
  const Vec3 direction = scale(state.linear.velocity, 1.0 / norm(state.linear.velocity));
  std::int32_t ticks = 0;
  for (; ticks < kMaxTicks && !at_rest(state); ++ticks) {
    const double speed = norm(state.linear.velocity);
    brake_tip(with, state);
    ASSERT_LE(norm(state.linear.velocity), speed + with.linear.jerk * with.tick_s * with.tick_s);  // slower and slower
    ASSERT_GE(dot(state.linear.velocity, direction), 0.0);  // and never backwards
  }
  EXPECT_LT(ticks, kMaxTicks);
  EXPECT_EQ(norm(state.linear.velocity), 0.0);
}

// req:A9
TEST(TipFilter, TheSlitsSpeedLowersTheBoundAndTheRobotsIsTheMost) {
  const RobotParams robot = zhu2022::table();
  EXPECT_EQ(tip_filter_config(robot, robot.limits.tip_speed_slit_m_s).linear.speed, robot.limits.tip_speed_slit_m_s);
  EXPECT_EQ(tip_filter_config(robot, 5.0).linear.speed, robot.limits.tip_speed_m_s);
  EXPECT_EQ(tip_filter_config(robot, 0.0).linear.speed, robot.limits.tip_speed_m_s);
  EXPECT_EQ(tip_filter_config(robot, -1.0).linear.speed, robot.limits.tip_speed_m_s);
}

// req:A9
TEST(TipFilter, ALowerSpeedLimitIsComeToWithinTheJerkWhileTheTipSpeedsUp) {
  const FilterBounds fast = config().linear;
  for (const double share : {0.2, 0.5, 0.9}) {
    ChannelState state;
    const double tick_s = config().tick_s;
    while (norm(state.velocity) < share * fast.speed) follow_channel(fast, tick_s, {1.0, 0.0, 0.0}, state);
    FilterBounds lower = fast;
    lower.pull_1_s = fast.accel / fast.speed;
    const double falls = 0.5 * fast.accel;
    double most = 0.0, before = state.velocity[0], rises = state.acceleration[0];
    for (std::int32_t i = 0; i < 300; ++i) {
      lower.speed = larger(0.3 * share * fast.speed, share * fast.speed - falls * i * tick_s);
      follow_channel(lower, tick_s, {1.0, 0.0, 0.0}, state);
      const double now = (state.velocity[0] - before) / tick_s;
      EXPECT_LE(std::fabs(now - rises), fast.jerk * tick_s * kWithRounding) << share << " " << i;
      rises = now;
      before = state.velocity[0];
      most = larger(most, state.velocity[0] - lower.speed);
    }
    const double change = fast.accel + falls;
    EXPECT_LE(most, 1.05 * 0.5 * change * change / fast.jerk) << "beyond the lower one for a moment";
    EXPECT_NEAR(state.velocity[0], lower.speed, 1e-4);
  }
}

// req:A9
TEST(TipFilter, ALowerSpeedLimitIsComeToWhereTheArmHasLittleJerkLeft) {
  FilterBounds bounds = config().linear;
  ChannelState state;
  const double tick_s = config().tick_s;
  while (norm(state.velocity) < 0.5 * bounds.speed) follow_channel(bounds, tick_s, {1.0, 0.0, 0.0}, state);
  const double before = norm(state.velocity), rises = norm(state.acceleration);
  bounds.pull_1_s = bounds.accel / bounds.speed;
  bounds.speed *= 0.05;
  bounds.accel *= 0.1;  // as the governor leaves it where the cables have no room
  bounds.jerk *= 0.03;
  double most = 0.0;
  for (std::int32_t i = 0; i < 1500; ++i) {
    follow_channel(bounds, tick_s, {1.0, 0.0, 0.0}, state);
    most = larger(most, state.velocity[0]);
  }
  EXPECT_LE(most, before + 0.11 * rises);
  EXPECT_NEAR(state.velocity[0], bounds.speed, 1e-3);
}

TEST(TipFilter, LimitsThatActAreNamed) {
  TipFilterState state;
  filter_tip(config(), {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, state);
  EXPECT_TRUE(state.speed_limited);
  EXPECT_TRUE(state.accel_limited);
  TipFilterState quiet;
  filter_tip(config(), {{1e-5, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, quiet);
  EXPECT_FALSE(quiet.speed_limited);
  EXPECT_FALSE(quiet.accel_limited);
}

// Turning about a fixed axis from an attitude that is far from the base's: an error taken in the tip's own frame would
// turn about another one.
TEST(TipFilter, TurnsAboutTheAxisBetweenTheTwoAttitudesInTheBaseFrame) {
  TipFilterState state;
  state.pose.quaternion = quaternion_of({0.0, 0.0, 1.5});
  const Pose target{{}, multiply(quaternion_of({0.4, 0.0, 0.0}), state.pose.quaternion)};
  for (std::int32_t i = 0; i < 200; ++i) {
    filter_tip(config(), target, state);
    const Vec3 rate = state.angular.velocity;
    ASSERT_GT(rate[0], 0.0) << i;
    ASSERT_LE(std::fabs(rate[1]) + std::fabs(rate[2]), 1e-9) << i;
  }
}

TEST(TipFilter, ASlowDirectionHasItsShareOfEveryBoundAndTheOthersAllOfThem) {
  TipFilterConfig slow = config();
  SlowDirections ways, turns;
  ways.share[0] = 0.01;
  turns.share[2] = 0.05;
  slow.slow_ways = &ways;
  slow.slow_turns = &turns;
  TipFilterState state, free;
  const Pose target{{0.3, 0.3, 0.0}, quaternion_of({0.3, 0.0, 0.3})};
  for (std::int32_t i = 0; i < 500; ++i) {
    const TipFilterState before = state;
    filter_tip(slow, target, state);
    filter_tip(config(), target, free);
    ASSERT_LE(std::fabs(state.linear.velocity[0]), 0.01 * slow.linear.speed * kWithRounding) << i;
    ASSERT_LE(std::fabs(state.linear.acceleration[0]), 0.01 * slow.linear.accel * kWithRounding) << i;
    ASSERT_LE(std::fabs(state.linear.acceleration[0] - before.linear.acceleration[0]),
              0.01 * slow.linear.jerk * slow.tick_s * kWithRounding)
        << i;
    ASSERT_LE(std::fabs(state.angular.velocity[2]), 0.05 * slow.angular.speed * kWithRounding) << i;
  }
  EXPECT_GT(state.pose.position_m[1], 0.6 * free.pose.position_m[1]);
  EXPECT_LT(state.pose.position_m[0], 0.02 * free.pose.position_m[0]);
}

// A filter with one slow direction of way, x.
struct SlowAlongX {
  explicit SlowAlongX(double share) {
    ways.share[0] = share;
    config.slow_ways = &ways;
  }
  SlowDirections ways;
  TipFilterConfig config = cable::config();
};

// Its speed is a share of the others', its way of coming there is theirs.
TEST(TipFilter, ASlowDirectionArrivesInTheTimeThatItsSpeedTakes) {
  const SlowAlongX along_x(0.2);
  const TipFilterConfig& slow = along_x.config;
  TipFilterState state;
  const Pose target{{0.03, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  const double travel_s = target.position_m[0] / (0.2 * slow.linear.speed);
  const auto ticks = static_cast<std::int32_t>((travel_s + 4.0) / slow.tick_s);
  for (std::int32_t i = 0; i < ticks; ++i) {
    filter_tip(slow, target, state);
    ASSERT_LE(state.linear.velocity[0], 0.2 * slow.linear.speed * kWithRounding) << i;
  }
  EXPECT_NEAR(state.pose.position_m[0], target.position_m[0], 0.001);
}

// The pose comes near one that loses directions while the tip moves: what it does now goes on, more slowly.
TEST(TipFilter, ADirectionThatBecomesSlowInMotionBrakesWithinTheBounds) {
  const SlowAlongX along_x(0.001);
  const TipFilterConfig& slow = along_x.config;
  TipFilterState state;
  const Pose target{{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  for (std::int32_t i = 0; i < 500; ++i) filter_tip(config(), target, state);
  ASSERT_GT(state.linear.velocity[0], 0.9 * config().linear.speed);
  for (std::int32_t i = 0; i < 1000; ++i) {
    const double before = state.linear.velocity[0];
    filter_tip(slow, target, state);
    const double braked = std::fabs(state.linear.velocity[0] - before) / slow.tick_s;
    ASSERT_LE(braked, 1.002 * config().linear.accel) << i << ": all of it, and the slow direction's share";
    ASSERT_GE(state.linear.velocity[0], 0.0) << i;
  }
  EXPECT_LT(state.linear.velocity[0], 0.0011 * slow.linear.speed);
}

}  // namespace
}  // namespace liana::cable
