// Rate and acceleration limiter.
#include "firmware_like/cable/motion/limiter.hpp"

#include <gtest/gtest.h>

#include "firmware_like/controller_io.hpp"
#include "tests/firmware_like/pose_of_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

constexpr double kRounding = 1e-12;

// What the last step of a braking parabola may go too far: less than a tick's change of rate can make good.
double overshoot_rad(const RobotParams& robot) {
  return robot.limits.theta_accel_rad_s2 * robot.tick_s * robot.tick_s / 8.0;
}

// One tick; checks rate and acceleration of the command and that the reported rate is the real one.
void step(const RobotParams& robot, const CableGeometry& geometry, const ThetaVector& reference, LimiterState& state) {
  const LimiterState before = state;
  limit_motion(robot, geometry, reference, state);
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
    const double rate = (state.theta_rad[k] - before.theta_rad[k]) / robot.tick_s;
    ASSERT_NEAR(rate, state.rate_rad_s[k], 1e-9);
    ASSERT_LE(std::fabs(state.rate_rad_s[k]), robot.limits.theta_rate_rad_s + kRounding);
    ASSERT_LE(std::fabs(state.rate_rad_s[k] - before.rate_rad_s[k]),
              robot.limits.theta_accel_rad_s2 * robot.tick_s + kRounding);
  }
}

LimiterState at_rest_at(const ThetaVector& theta) {
  LimiterState state;
  reset_limiter(theta, state);
  return state;
}

// Steps, ramps and noise in turn, some far faster than any limit.
ThetaVector next_reference(const RobotParams& robot, Random& random, std::int32_t tick, std::int32_t kind,
                           const ThetaVector& before) {
  if (kind % 3 == 0) return tick % 50 == 0 ? random.theta(robot, 20.0) : before;
  if (kind % 3 == 1) return zhu2022::plus(before, random.theta(robot, 0.02));
  return random.theta(robot, 1.0);
}

TEST(Limiter, AThousandRandomReferencesNeverPassRateOrAcceleration) {
  const RobotParams robot = zhu2022::table();
  Random random(1);
  for (std::int32_t kind = 0; kind < 1000; ++kind) {
    ThetaVector reference = random.theta(robot, 10.0);
    LimiterState state = at_rest_at(reference);
    const CableGeometry geometry = geometry_at(robot, reference);
    for (std::int32_t tick = 0; tick < 200; ++tick) {
      reference = next_reference(robot, random, tick, kind, reference);
      step(robot, geometry, reference, state);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Limiter, FollowsToTheLastBitInsideTheLimits) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector start = zhu2022::radians(zhu2022::kPrepare_deg);
  LimiterState state = at_rest_at(start);
  const CableGeometry geometry = geometry_at(robot, start);
  for (std::int32_t i = 1; i <= 3000; ++i) {
    ThetaVector reference = start;  // 1 deg/s and 3.1 deg/s2 at most
    for (std::size_t k = 0; k < 2; ++k) reference[k] += 0.3 * kDegree * (1.0 - std::cos(0.5 * kPi * i * robot.tick_s));
    limit_motion(robot, geometry, reference, state);
    ASSERT_EQ(state.theta_rad, reference) << i;
    ASSERT_EQ(state.limits, 0u) << i;
  }
}

TEST(Limiter, AStepIsReachedExactlyWithAtMostTheStatedOvershoot) {
  const RobotParams robot = zhu2022::table();
  Random random(2);
  for (std::int32_t i = 0; i < 30; ++i) {
    const ThetaVector from = random.theta(robot, 15.0), to = zhu2022::plus(from, random.theta(robot, 4.0));
    LimiterState state = at_rest_at(from);
    const CableGeometry geometry = geometry_at(robot, from);
    for (std::int32_t tick = 0; tick < 5000; ++tick) {
      step(robot, geometry, to, state);
      if (HasFatalFailure()) return;
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
        const double way = to[k] - from[k], done = state.theta_rad[k] - from[k];
        const double past = way > 0.0 ? done - way : way - done;
        ASSERT_LE(past, overshoot_rad(robot) + kRounding) << i;
        ASSERT_GE(done * way, -1e-15);
      }
    }
    ASSERT_EQ(state.theta_rad, to);
    ASSERT_LE(largest_rate(robot, state), 1e-9);
  }
}

TEST(Limiter, CatchesUpWithAMovingReferenceWithoutPassingIt) {
  const RobotParams robot = zhu2022::table();
  LimiterState state = at_rest_at(ThetaVector{});
  const CableGeometry geometry = geometry_at(robot, ThetaVector{});
  ThetaVector reference{};
  reference[0] = 0.5 * kDegree;  // a step, then a ramp of 0.5 deg/s
  for (std::int32_t i = 0; i < 2000; ++i) {
    reference[0] += 0.5 * kDegree * robot.tick_s;
    step(robot, geometry, reference, state);
    if (HasFatalFailure()) return;
    ASSERT_LE(state.theta_rad[0], reference[0] + 2.0 * overshoot_rad(robot));
  }
  EXPECT_EQ(state.theta_rad[0], reference[0]);
}

// A reference that runs against a joint limit and stands there: a lagging command, on its way at full rate, must not
// swing past it.
TEST(Limiter, ALaggingCommandStopsBeforeTheJointLimitWithoutBrakingHarderThanItMay) {
  const RobotParams robot = zhu2022::table();
  const double limit = robot.segment[0].theta_limit_rad;
  const CableGeometry geometry = geometry_at(robot, ThetaVector{});
  Random random(3);
  for (std::int32_t i = 0; i < 20; ++i) {
    ThetaVector reference = random.theta(robot, 17.0);
    LimiterState state = at_rest_at(reference);
    const double speed =
        random.uniform(1.0, 6.0) * robot.limits.theta_rate_rad_s;  // of the reference: too fast to follow
    for (std::int32_t tick = 0; tick < 10000; ++tick) {
      for (std::size_t k = 8; k < 10; ++k) {
        reference[k] = std::clamp(reference[k] + (k % 2 == 0 ? speed : -speed) * robot.tick_s, -limit, limit);
      }
      step(robot, geometry, reference, state);
      if (HasFatalFailure()) return;
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k)
        ASSERT_LE(std::fabs(state.theta_rad[k]), limit + kRounding) << k;
    }
    EXPECT_LE(zhu2022::largest_difference(state.theta_rad, reference), 1e-6);
  }
}

TEST(Limiter, EveryLimitThatActsIsNamed) {
  RobotParams robot = zhu2022::table();
  robot.limits.cable_speed_m_s = 1000.0;
  const CableGeometry geometry = geometry_at(robot, ThetaVector{});
  LimiterState state = at_rest_at(ThetaVector{});
  ThetaVector far{};
  far[1] = 10.0 * kDegree;
  limit_motion(robot, geometry, far, state);
  EXPECT_EQ(state.limits, kLimitThetaRate | kLimitThetaAccel);
  robot.limits.cable_speed_m_s = 0.001;
  limit_motion(robot, geometry, far, state);
  EXPECT_TRUE(state.limits & kLimitCableSpeed);
}

TEST(Limiter, CablesStayUnderTheirSpeedWhenAllAnglesMoveAtOnce) {
  const RobotParams robot = zhu2022::table();
  Random random(3);
  for (std::int32_t i = 0; i < 50; ++i) {
    const ThetaVector far = random.theta(robot, 20.0);
    const CableGeometry geometry = geometry_at(robot, ThetaVector{});
    LimiterState state = at_rest_at(ThetaVector{});
    for (std::int32_t tick = 0; tick < 400; ++tick) {
      limit_motion(robot, geometry, far, state);
      for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
        double speed = 0.0;
        for (std::size_t k = 0; k < zhu2022::kThetas; ++k) speed += geometry.jacobian_m_rad[c][k] * state.rate_rad_s[k];
        ASSERT_LE(std::fabs(speed), robot.limits.cable_speed_m_s) << c;
      }
    }
  }
}

TEST(Limiter, ResetStandsStillWhereItIsTold) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector pose = zhu2022::radians(zhu2022::kPressRod_deg);
  LimiterState state = at_rest_at(pose);
  EXPECT_EQ(largest_rate(robot, state), 0.0);
  limit_motion(robot, geometry_at(robot, pose), pose, state);
  EXPECT_EQ(state.theta_rad, pose);
  EXPECT_EQ(state.limits, 0u);
}

}  // namespace
}  // namespace liana::cable
