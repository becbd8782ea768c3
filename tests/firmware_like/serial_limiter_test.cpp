// Rate and acceleration limiter of the serial arm.
#include "firmware_like/serial/limiter.hpp"

#include <gtest/gtest.h>

#include "firmware_like/safety/limits.hpp"
#include "firmware_like/serial/torque_drive.hpp"
#include "tests/firmware_like/micro_arm.hpp"

namespace liana::serial {
namespace {

using micro::Random;

constexpr double kRounding = 1e-12;

LimiterState at_rest_at(const JointVector& joint) {
  LimiterState state;
  reset_limiter(joint, state);
  return state;
}

// One tick; checks range, rate and acceleration of the command, and that the reported rate is the real one.
void step(const RobotParams& robot, const JointVector& reference, LimiterState& state) {
  const LimiterState before = state;
  limit_motion(robot, reference, state);
  ASSERT_TRUE(micro::within_ranges(robot, state.joint_rad));
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const double rate = (state.joint_rad[i] - before.joint_rad[i]) / robot.tick_s;
    ASSERT_NEAR(rate, state.rate_rad_s[i], 1e-9);
    ASSERT_LE(std::fabs(state.rate_rad_s[i]), robot.joint[i].rate_rad_s + kRounding);
    ASSERT_LE(std::fabs(state.rate_rad_s[i] - before.rate_rad_s[i]),
              robot.joint[i].accel_rad_s2 * robot.tick_s + kRounding);
  }
}

// Joints that differ in all their limits.
RobotParams uneven_robot() {
  RobotParams robot = micro::six_joint_table();
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    robot.joint[i].rate_rad_s *= 1.0 + 0.2 * static_cast<double>(i);
    robot.joint[i].accel_rad_s2 *= 2.0 - 0.3 * static_cast<double>(i);
  }
  return robot;
}

// Steps, ramps and noise in turn, some far faster than any limit.
JointVector next_reference(const RobotParams& robot, Random& random, std::int32_t tick, std::int32_t kind,
                           const JointVector& before) {
  if (kind % 3 == 0) return tick % 50 == 0 ? micro::random_joints(robot, random) : before;
  if (kind % 3 == 1) return micro::near(robot, before, random, 0.02 * kDegree);
  return micro::random_joints(robot, random);
}

TEST(SerialLimiter, AThousandRandomReferencesNeverPassRangeRateOrAcceleration) {
  const RobotParams robot = uneven_robot();
  Random random(1);
  for (std::int32_t kind = 0; kind < 1000; ++kind) {
    JointVector reference = micro::random_joints(robot, random);
    LimiterState state = at_rest_at(reference);
    for (std::int32_t tick = 0; tick < 200; ++tick) {
      reference = next_reference(robot, random, tick, kind, reference);
      step(robot, reference, state);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(SerialLimiter, AReferenceInsideTheLimitsIsFollowedExactly) {
  const RobotParams robot = uneven_robot();
  LimiterState state = at_rest_at({});
  JointVector reference{};
  double rate = 0.0;
  for (std::int32_t tick = 0; tick < 500; ++tick) {
    rate = std::min(rate + 0.4 * robot.joint[5].accel_rad_s2 * robot.tick_s, 0.9 * robot.joint[0].rate_rad_s);
    for (std::size_t i = 0; i < robot.joints(); ++i) reference[i] += rate * robot.tick_s;
    step(robot, reference, state);
    ASSERT_EQ(state.joint_rad, reference) << tick;
    ASSERT_EQ(state.limits, 0u);
  }
}

TEST(SerialLimiter, EveryLimitThatActsNamesItself) {
  const RobotParams robot = micro::table();
  LimiterState state = at_rest_at({});
  JointVector far{};
  far[2] = robot.joint[2].high_rad;
  limit_motion(robot, far, state);
  EXPECT_EQ(state.limits & (kLimitThetaAccel | kLimitThetaRate), kLimitThetaAccel | kLimitThetaRate);
  far[2] = robot.joint[2].high_rad + 1.0;
  std::uint32_t seen = 0;
  for (std::int32_t tick = 0; tick < 30000; ++tick) {
    step(robot, far, state);
    seen |= state.limits;
  }
  EXPECT_TRUE((seen & kLimitTheta) != 0);
  EXPECT_NEAR(state.joint_rad[2], robot.joint[2].high_rad, 1e-6);
}

LimiterState moving(const RobotParams& robot, Random& random) {
  LimiterState state = at_rest_at(micro::random_joints(robot, random, 0.5));
  for (std::size_t i = 0; i < robot.joints(); ++i)
    state.rate_rad_s[i] = robot.joint[i].rate_rad_s * random.uniform(-1.0, 1.0);
  return state;
}

// The path is kept: the joints' rates keep their proportion until all are zero.
TEST(SerialLimiter, BrakingJointsKeepTheirProportionAndComeToRestTogether) {
  const RobotParams robot = uneven_robot();
  Random random(2);
  for (std::int32_t i = 0; i < 200; ++i) {
    const LimiterState start = moving(robot, random);
    LimiterState state = start;
    std::int32_t tick = 0;
    for (; largest_rate(robot, state) > 0.0 && tick < 1000; ++tick) {
      const JointVector next = braked_joints(robot, state);
      state.reference_rad = state.joint_rad;
      step(robot, next, state);
      if (HasFatalFailure()) return;
      const double part = state.rate_rad_s[0] / start.rate_rad_s[0];
      for (std::size_t k = 0; k < robot.joints(); ++k)
        ASSERT_NEAR(state.rate_rad_s[k], part * start.rate_rad_s[k], 1e-9);
    }
    ASSERT_LT(tick, 1000);
  }
}

TEST(SerialLimiter, TheAllowedShareOfAStepPassesUnchanged) {
  const RobotParams robot = uneven_robot();
  Random random(3);
  std::int32_t cut = 0;
  for (std::int32_t i = 0; i < 2000; ++i) {
    LimiterState state = at_rest_at({});
    JointVector asked{};
    for (std::size_t k = 0; k < robot.joints(); ++k)
      asked[k] = random.uniform(-3.0, 3.0) * robot.joint[k].rate_rad_s * robot.tick_s;
    const StepShare allowed = allowed_share(robot, asked, state);
    cut += allowed.share < 1.0 ? 1 : 0;
    ASSERT_EQ(allowed.share < 1.0, allowed.limits != 0);
    for (double& x : asked) x *= allowed.share;
    step(robot, asked, state);
    ASSERT_LE(micro::largest_difference(state.joint_rad, asked), 1e-15);
  }
  EXPECT_GT(cut, 1000);
}

// Where a base has swung, the joints stand off their targets as force begins: what is verified then goes by the
// targets.
TEST(FollowAlong, ATargetThatForcesLeadGoesNoQuickerThanItsJointsAndGetsThere) {
  const RobotParams robot = uneven_robot();
  JointVector measured{};
  for (std::size_t i = 0; i < robot.joints(); ++i) measured[i] = i % 2 == 0 ? 0.05 : -0.08;
  LimiterState target = at_rest_at({});
  for (int tick = 0; tick < 500; ++tick) {
    const JointVector before = target.joint_rad;
    follow_along(robot, {}, measured, target);
    for (std::size_t i = 0; i < robot.joints(); ++i) {
      const double rate = (target.joint_rad[i] - before[i]) / robot.tick_s;
      ASSERT_LE(std::fabs(rate), robot.joint[i].rate_rad_s + kRounding) << i;
    }
  }
  EXPECT_LT(micro::largest_difference(target.joint_rad, measured), 1e-9);
}

}  // namespace
}  // namespace liana::serial
