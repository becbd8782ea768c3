// Motion stage: setpoints, interpolation, held variables, switching, braking.
#include "firmware_like/cable/motion/motion.hpp"

#include <gtest/gtest.h>

#include "firmware_like/controller_io.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::kX4AndX5;
using zhu2022::kX5;

// An arm at rest whose every tick is checked against the rate and acceleration limits of the robot.
class Motion : public testing::Test {
 protected:
  void SetUp() override { reset_motion(robot_, zhu2022::radians(zhu2022::kPanelEdge_deg), state_); }

  void run(std::int32_t ticks, bool allowed = true) {
    for (std::int32_t i = 0; i < ticks; ++i) {
      const LimiterState before = state_.limiter;
      const CableGeometry geometry = cable_geometry(robot_, layout_, arm_trig(robot_, state_.limiter.theta_rad));
      advance_motion(robot_, geometry, allowed, state_);
      limits_seen_ |= state_.limits;
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
        const double change = state_.limiter.rate_rad_s[k] - before.rate_rad_s[k];
        ASSERT_LE(std::fabs(state_.limiter.rate_rad_s[k]), robot_.limits.theta_rate_rad_s + 1e-12) << k;
        ASSERT_LE(std::fabs(change), robot_.limits.theta_accel_rad_s2 * robot_.tick_s + 1e-12) << k;
      }
    }
  }

  Pose tip() const { return forward_kinematics(robot_, state_.limiter.theta_rad).tip_in_base; }
  const ThetaVector& theta() const { return state_.limiter.theta_rad; }

  // A tip setpoint `move_m` away from where the filter stands.
  Setpoint tip_setpoint(const Vec3& move_m, std::uint32_t held = 0) const {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_in_base = state_.filter.pose;
    setpoint.tip_in_base.position_m = add(setpoint.tip_in_base.position_m, move_m);
    setpoint.held_mask = held;
    setpoint.tip_speed_m_s = robot_.limits.tip_speed_m_s;
    return setpoint;
  }
  static Setpoint joint_setpoint(const ThetaVector& theta) {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    setpoint.joint_rad = theta;
    return setpoint;
  }

  RobotParams robot_ = zhu2022::table();
  CableLayout layout_ = cable_layout(robot_);
  MotionState state_{};
  std::uint32_t limits_seen_ = 0;
};

TEST_F(Motion, WithoutASetpointNothingMoves) {
  const ThetaVector start = theta();
  run(200);
  EXPECT_EQ(theta(), start);
  EXPECT_TRUE(at_rest(robot_, state_));
}

// req:A17
TEST_F(Motion, TheTipReachesItsTargetAndThenKeepsIt) {
  const Setpoint setpoint = tip_setpoint({0.10, -0.05, 0.02});
  accept_setpoint(robot_, setpoint, state_);
  run(4000);
  EXPECT_LE(zhu2022::length(pose_error(setpoint.tip_in_base, tip())), 1e-4);
  EXPECT_LE(zhu2022::length(pose_error(setpoint.tip_in_base, state_.filter.pose)), 1e-9);
}

// What the limits held back is made up for as it can be braked from; at once, it would swing the arm.
TEST_F(Motion, AnArmThatIsBehindCatchesUpNoFasterThanItCanSlowDownAgain) {
  accept_setpoint(robot_, tip_setpoint({0.0, 0.0, 0.0}), state_);
  run(50);
  for (const double behind_m : {0.0005, 0.002}) {
    state_.filter.pose.position_m[1] += behind_m;
    state_.to.tip_in_base = state_.from.tip_in_base = state_.filter.pose;
    state_.ik.residual = {0.0, behind_m, 0.0, 0.0, 0.0, 0.0};
    const double max_m_s = std::sqrt(2.0 * 0.3 * robot_.limits.tip_accel_m_s2 * behind_m);
    double fastest_m_s = 0.0, harder_m_s2 = 0.0, before_m_s = 0.0;
    for (int i = 0; i < 400; ++i) {
      const Pose from = tip();
      run(1);
      const double speed_m_s = norm(subtract(tip().position_m, from.position_m)) / robot_.tick_s;
      fastest_m_s = std::max(fastest_m_s, speed_m_s);
      harder_m_s2 = std::max(harder_m_s2, (before_m_s - speed_m_s) / robot_.tick_s);
      before_m_s = speed_m_s;
    }
    EXPECT_LT(fastest_m_s, 1.05 * max_m_s) << behind_m;
    EXPECT_GT(fastest_m_s, 0.5 * max_m_s) << behind_m;
    EXPECT_LT(harder_m_s2, 0.6 * robot_.limits.tip_accel_m_s2) << "as it slows down";
    EXPECT_LT(zhu2022::length(pose_error(state_.filter.pose, tip())), 1e-7) << "it has caught up";
  }
}

TEST_F(Motion, JointAnglesReachTheirTargetExactly) {
  const ThetaVector goal = zhu2022::plus(theta(), zhu2022::Random(1).theta(robot_, 0.3));
  accept_setpoint(robot_, joint_setpoint(goal), state_);
  run(2000);
  EXPECT_EQ(theta(), goal);
  EXPECT_TRUE(at_rest(robot_, state_));
}

// A stream of setpoints on a line, one per interval, is a line at every tick.
// req:C3
TEST_F(Motion, InterpolationOverTheCommandIntervalHasNoSteps) {
  const ThetaVector start = theta();
  for (std::int32_t interval = 1; interval <= 200; ++interval) {
    ThetaVector goal = start;
    goal[0] += 0.01 * kDegree * interval;  // 0.5 deg/s
    accept_setpoint(robot_, joint_setpoint(goal), state_);
    const double before = state_.ik_rad[0];
    for (std::int32_t tick = 1; tick <= robot_.interval_ticks; ++tick) {
      run(1);
      ASSERT_NEAR(state_.ik_rad[0] - before, 0.01 * kDegree * tick / robot_.interval_ticks, 1e-12);
    }
  }
}

// A held pitch goes to its target at a bounded rate and then keeps its bits while the tip moves on.
// req:A38 req:A41
TEST_F(Motion, HeldVariablesReachTheirTargetAndStayExactlyThere) {
  accept_setpoint(robot_, tip_setpoint({}, kX5), state_);
  run(1);
  EXPECT_FALSE(state_.held_at_target);
  run(2500);
  ASSERT_TRUE(state_.held_at_target);
  for (std::int32_t interval = 0; interval < 100; ++interval) {
    accept_setpoint(robot_, tip_setpoint({0.0, 0.0, 0.005}, kX5), state_);
    for (std::int32_t tick = 0; tick < robot_.interval_ticks; ++tick) {
      run(1);
      ASSERT_EQ(state_.ik_rad[8], 0.0);
      ASSERT_EQ(theta()[8], 0.0);
    }
  }
  EXPECT_GT(tip().position_m[2], 0.59);
}

// 10+0, 9+1, 8+2 and back while moving: the fixture checks every tick, and the tip stays on its way.
// req:A38
TEST_F(Motion, SwitchingBetweenTenNineAndEightVariablesIsBumpless) {
  for (const std::uint32_t held : {0u, kX5, kX4AndX5, kX5, 0u}) {
    for (std::int32_t interval = 0; interval < 600; ++interval) {
      accept_setpoint(robot_, tip_setpoint({0.0004, 0.0, 0.0}, held), state_);
      const ThetaVector before = state_.ik_rad;
      run(1);
      // What the IK asks of the limiter at the switch is no more than what a tick may do.
      ASSERT_LE(zhu2022::largest_difference(before, state_.ik_rad), robot_.limits.theta_rate_rad_s * robot_.tick_s)
          << held;
      run(robot_.interval_ticks - 1);
    }
    ASSERT_LE(zhu2022::length(pose_error(state_.filter.pose, tip())), 2e-3) << held;
  }
}

TEST_F(Motion, SwitchingFromJointToTipMotionTakesTheMotionOver) {
  for (std::int32_t interval = 1; interval <= 50; ++interval) {
    ThetaVector goal = theta();
    for (std::size_t k = 0; k < zhu2022::kThetas; k += 2) goal[k] += 0.008 * kDegree;
    accept_setpoint(robot_, joint_setpoint(goal), state_);
    run(robot_.interval_ticks);
  }
  const Pose before = tip();
  accept_setpoint(robot_, tip_setpoint({}), state_);
  EXPECT_LE(zhu2022::length(pose_error(before, state_.filter.pose)), 1e-12);
  run(1500);
  EXPECT_TRUE(state_.filter.linear.velocity[0] == 0.0 || std::fabs(state_.filter.linear.velocity[0]) < 1e-6);
}

TEST_F(Motion, BrakingComesToRestFromTipAndFromJointMotion) {
  for (const bool joint : {false, true}) {
    if (joint) {
      accept_setpoint(robot_, joint_setpoint(ThetaVector{}), state_);
    } else {
      accept_setpoint(robot_, tip_setpoint({0.5, 0.0, 0.0}), state_);
    }
    run(300);
    ASSERT_FALSE(at_rest(robot_, state_));
    state_.braking = true;
    std::int32_t ticks = 0;
    for (; ticks < 1000 && !at_rest(robot_, state_); ++ticks) run(1);
    EXPECT_LT(ticks, 1000) << joint;
    const ThetaVector stood = theta();
    run(250);
    EXPECT_LE(zhu2022::largest_difference(theta(), stood), 1e-4 * kDegree) << joint;
  }
}

// Joints that stopped one by one would leave the path, and what cancels at the tip would not cancel any more.
TEST_F(Motion, BrakingJointMotionKeepsTheProportionOfTheRates) {
  ThetaVector goal = theta();
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k)
    goal[k] += (k % 2 == 0 ? 0.002 : -0.0005) * static_cast<double>(k + 1);
  accept_setpoint(robot_, joint_setpoint(goal), state_);
  run(20);
  const ThetaVector rate = state_.limiter.rate_rad_s;
  ASSERT_GT(rate[0], 0.0);
  ASSERT_GT(std::fabs(rate[8]), 2.0 * std::fabs(rate[1]));
  state_.braking = true;
  for (int i = 0; i < 250 && !at_rest(robot_, state_); ++i) {
    run(1);
    const double share = state_.limiter.rate_rad_s[8] / rate[8];
    EXPECT_GE(share, 0.0);
    EXPECT_LT(share, 1.0);
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k)
      EXPECT_NEAR(state_.limiter.rate_rad_s[k], share * rate[k], 1e-12) << k;
  }
  EXPECT_TRUE(at_rest(robot_, state_));
}

TEST_F(Motion, MotionThatIsNotAllowedBrakes) {
  accept_setpoint(robot_, tip_setpoint({0.5, 0.0, 0.0}), state_);
  run(300);
  ASSERT_FALSE(at_rest(robot_, state_));
  run(1000, false);
  EXPECT_TRUE(at_rest(robot_, state_));
}

// Out of reach the IK has no solution: the command must still be one that the arm can follow, and say why it does not
// arrive; the filtered target waits for it.
TEST_F(Motion, ATargetOutOfReachBreaksNoLimitAndIsNamed) {
  accept_setpoint(robot_, tip_setpoint({0.0, 0.0, 6.0}), state_);
  for (std::int32_t i = 0; i < 10; ++i) {
    run(1500);
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k)
      ASSERT_LE(std::fabs(theta()[k]), robot_.segment[k / 2].theta_limit_rad) << k;
  }
  EXPECT_GT(norm(subtract(state_.to.tip_in_base.position_m, state_.filter.pose.position_m)), 0.5);
  EXPECT_LT(state_.ik.position_error_m, 0.03);
  EXPECT_TRUE(limits_seen_ & (kLimitTheta | kLimitSingular));
}

TEST_F(Motion, LimitsNameThemselves) {
  ThetaVector beyond = theta();
  beyond[1] = 25.0 * kDegree;
  accept_setpoint(robot_, joint_setpoint(beyond), state_);
  run(10);
  EXPECT_TRUE(limits_seen_ & kLimitTheta);
  EXPECT_TRUE(limits_seen_ & kLimitThetaRate);
  EXPECT_TRUE(limits_seen_ & kLimitThetaAccel);
  limits_seen_ = 0;
  accept_setpoint(robot_, tip_setpoint({1.0, 0.0, 0.0}), state_);
  run(10);
  EXPECT_TRUE(limits_seen_ & kLimitTipSpeed);
  EXPECT_TRUE(limits_seen_ & kLimitTipAccel);
}

}  // namespace
}  // namespace liana::cable
