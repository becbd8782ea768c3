// Motion stage of the serial arm: joints and tip follow their setpoints, and everything stops on its path.
#include "firmware_like/serial/motion.hpp"

#include <gtest/gtest.h>

#include "firmware_like/safety/limits.hpp"
#include "tests/firmware_like/micro_arm.hpp"

namespace liana::serial {
namespace {

using micro::Random;

MotionState standing_at(const RobotParams& robot, const JointVector& joint) {
  MotionState state;
  reset_motion(robot, joint, state);
  return state;
}

Setpoint joint_setpoint(const JointVector& joint) {
  Setpoint setpoint;
  setpoint.kind = CommandKind::kJoint;
  setpoint.joint_rad = joint;
  return setpoint;
}

Setpoint tip_setpoint(const Pose& tip, double speed_m_s = 0.1) {
  Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  setpoint.tip_in_base = tip;
  setpoint.tip_speed_m_s = speed_m_s;
  return setpoint;
}

// One tick; range, rate, acceleration and jumps of the command are checked.
void tick(const RobotParams& robot, MotionState& state, bool allowed = true) {
  const LimiterState before = state.limiter;
  advance_motion(robot, allowed, state);
  ASSERT_TRUE(micro::within_ranges(robot, state.limiter.joint_rad));
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const double rate = (state.limiter.joint_rad[i] - before.joint_rad[i]) / robot.tick_s;
    ASSERT_LE(std::fabs(rate), robot.joint[i].rate_rad_s + 1e-9);
    ASSERT_LE(std::fabs(rate - before.rate_rad_s[i]), robot.joint[i].accel_rad_s2 * robot.tick_s + 1e-9);
  }
}

void run(const RobotParams& robot, std::int32_t ticks, MotionState& state, bool allowed = true) {
  for (std::int32_t i = 0; i < ticks; ++i) {
    tick(robot, state, allowed);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// As the arbiter does it: a setpoint per interval, on the way.
void lead_joints(const RobotParams& robot, const JointVector& from, const JointVector& to, double duration_s,
                 MotionState& state) {
  const auto intervals = static_cast<std::int32_t>(duration_s / (robot.tick_s * robot.interval_ticks));
  for (std::int32_t i = 1; i <= intervals; ++i) {
    const double x = static_cast<double>(i) / intervals, share = x * x * (3.0 - 2.0 * x);
    JointVector joint{};
    for (std::size_t k = 0; k < robot.joints(); ++k) joint[k] = from[k] + share * (to[k] - from[k]);
    accept_setpoint(robot, joint_setpoint(joint), state);
    run(robot, robot.interval_ticks, state);
    if (testing::Test::HasFatalFailure()) return;
  }
}

double tip_distance(const MotionState& state, const Pose& goal) {
  return norm(subtract(state.arm.tip_in_base.position_m, goal.position_m)) +
         norm(rotation_vector(multiply(state.arm.tip_in_base.quaternion, conjugate(goal.quaternion))));
}

TEST(SerialMotion, JointsArriveExactlyWhereTheyAreLed) {
  const RobotParams robot = micro::table();
  const JointVector start = micro::radians(micro::kBent_deg);
  JointVector goal = start;
  for (std::size_t i = 0; i < robot.joints(); ++i) goal[i] += (i % 2 == 0 ? 3.0 : -2.0) * kDegree;
  MotionState state = standing_at(robot, start);
  lead_joints(robot, start, goal, 3.0, state);
  run(robot, 50, state);
  EXPECT_LE(micro::largest_difference(state.limiter.joint_rad, goal), 1e-12);
  EXPECT_TRUE(at_rest(robot, state));
}

TEST(SerialMotion, TheTipArrivesAndTheJointsStandStill) {
  const RobotParams robot = micro::table();
  MotionState state = standing_at(robot, micro::radians(micro::kBent_deg));
  Pose goal = state.arm.tip_in_base;
  goal.position_m = add(goal.position_m, {0.2, -0.1, 0.15});
  goal.quaternion = multiply(quaternion_of({0.05, 0.02, -0.04}), goal.quaternion);
  accept_setpoint(robot, tip_setpoint(goal), state);
  run(robot, 4000, state);
  EXPECT_LE(tip_distance(state, goal), 2e-6);
  EXPECT_EQ(state.ik.outcome, IkOutcome::kConverged);
  EXPECT_TRUE(at_rest(robot, state));
}

TEST(SerialMotion, TheTipStaysOnItsStraightLine) {
  const RobotParams robot = micro::table();
  MotionState state = standing_at(robot, micro::radians(micro::kBent_deg));
  const Pose start = state.arm.tip_in_base;
  Pose goal = start;
  const Vec3 way{0.3, 0.0, -0.2};
  goal.position_m = add(start.position_m, way);
  accept_setpoint(robot, tip_setpoint(goal), state);
  for (std::int32_t i = 0; i < 2500; ++i) {
    tick(robot, state);
    const Vec3 gone = subtract(state.arm.tip_in_base.position_m, start.position_m);
    const Vec3 aside = subtract(gone, scale(way, dot(gone, way) / dot(way, way)));
    ASSERT_LE(norm(aside), 2e-5) << i;
  }
}

TEST(SerialMotion, ASetpointsSpeedBoundsTheTip) {
  const RobotParams robot = micro::table();
  MotionState state = standing_at(robot, micro::radians(micro::kBent_deg));
  Pose goal = state.arm.tip_in_base;
  goal.position_m[2] += 0.3;
  accept_setpoint(robot, tip_setpoint(goal, 0.02), state);
  double fastest = 0.0;
  for (std::int32_t i = 0; i < 3000; ++i) {
    tick(robot, state);
    fastest = std::max(fastest, norm(tip_twist(robot, state.arm.tip_jacobian, state.limiter.rate_rad_s).linear_m_s));
  }
  EXPECT_LE(fastest, 0.0202);
  EXPECT_GE(fastest, 0.0195);
}

// A stop within a second from anywhere on the way, and without leaving the limits on the way down.
TEST(SerialMotion, StopsWhenItIsNoLongerAllowed) {
  const RobotParams robot = micro::table();
  Random random(1);
  for (std::int32_t i = 0; i < 40; ++i) {
    MotionState state = standing_at(robot, micro::random_joints(robot, random, 0.7));
    if (i % 2 == 0) {
      const JointVector far = micro::random_joints(robot, random, 0.9);
      for (std::int32_t k = 0; k < 100; ++k) {
        accept_setpoint(robot, joint_setpoint(far), state);
        run(robot, robot.interval_ticks, state);
      }
    } else {
      Pose goal = state.arm.tip_in_base;
      goal.position_m =
          add(goal.position_m, {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)});
      accept_setpoint(robot, tip_setpoint(goal), state);
      run(robot, 500, state);
    }
    if (HasFatalFailure()) return;
    run(robot, 1000, state, false);
    ASSERT_TRUE(at_rest(robot, state)) << i;
    const JointVector rest = state.limiter.joint_rad;
    run(robot, 100, state, false);
    ASSERT_LE(micro::largest_difference(state.limiter.joint_rad, rest), 1e-8) << i;
  }
}

// The spare joint goes towards the middle of its range while the tip moves, and not while it rests.
TEST(SerialMotion, TheArmTurnsOnlyWhileTheTipMoves) {
  const RobotParams robot = micro::table();
  MotionState state = standing_at(robot, micro::radians({200, -117, -97, 139, 125, 107, 250}));
  const JointVector start = state.limiter.joint_rad;
  Pose goal = state.arm.tip_in_base;
  accept_setpoint(robot, tip_setpoint(goal), state);
  run(robot, 1000, state);
  EXPECT_LE(micro::largest_difference(state.limiter.joint_rad, start), 1e-9);
}

TEST(SerialMotion, GoesFromJointsToTipAndBackWithoutAJump) {
  const RobotParams robot = micro::table();
  const JointVector start = micro::radians(micro::kBent_deg);
  MotionState state = standing_at(robot, start);
  JointVector there = start;
  for (double& x : there) x += 5.0 * kDegree;
  Pose goal = state.arm.tip_in_base;
  goal.position_m[0] += 0.1;
  for (std::int32_t round = 0; round < 20; ++round) {
    accept_setpoint(robot, round % 2 == 0 ? joint_setpoint(there) : tip_setpoint(goal), state);
    run(robot, 100, state);  // tick() checks that rates change within the acceleration
    if (HasFatalFailure()) return;
  }
}

// A goal out of reach leads to a stretched arm that says so and can be led back.
TEST(SerialMotion, ComesBackFromAGoalOutOfReach) {
  const RobotParams robot = micro::table();
  MotionState state = standing_at(robot, micro::radians(micro::kBent_deg));
  const Pose home = state.arm.tip_in_base;
  Pose far = home;
  far.position_m = scale(home.position_m, 5.8 / norm(home.position_m));
  accept_setpoint(robot, tip_setpoint(far), state);
  run(robot, 20000, state);
  EXPECT_TRUE((state.limits & (kLimitReach | kLimitSingular)) != 0) << state.limits;
  accept_setpoint(robot, tip_setpoint(home), state);
  run(robot, 40000, state);
  EXPECT_LE(tip_distance(state, home), 1e-4);
}

TEST(SerialMotion, OnlyUsableSetpointsAreUsable) {
  const RobotParams robot = micro::table();
  const Pose tip = forward_kinematics(robot, {}).tip_in_base;
  const double nan = std::nan("");
  EXPECT_TRUE(is_usable(robot, tip_setpoint(tip)));
  const LinkMass good{500.0, {0.0, 0.0, 0.5}, {80.0, 80.0, 80.0, 0.0, 0.0, 0.0}};
  for (const auto& [body, usable] : {std::pair{good, true},
                                     {LinkMass{}, true},
                                     {LinkMass{nan, good.center_m, good.inertia_kgm2}, false},
                                     {LinkMass{-1.0, good.center_m, good.inertia_kgm2}, false},
                                     {LinkMass{2.0 * kMaxMass_kg, good.center_m, good.inertia_kgm2}, false},
                                     {LinkMass{500.0, {0.0, nan, 0.0}, good.inertia_kgm2}, false},
                                     {LinkMass{500.0, good.center_m, {}}, false},
                                     {LinkMass{500.0, good.center_m, {80.0, 80.0, 170.0, 0.0, 0.0, 0.0}}, false},
                                     {LinkMass{500.0, good.center_m, {80.0, 80.0, 80.0, 90.0, 0.0, 0.0}}, false}}) {
    Setpoint carrying = tip_setpoint(tip);
    carrying.payload_at_tip = body;
    EXPECT_EQ(is_usable(robot, carrying), usable) << body.mass_kg << " kg";
  }
  EXPECT_FALSE(is_usable(robot, tip_setpoint(tip, 0.0)));
  EXPECT_FALSE(is_usable(robot, tip_setpoint(tip, nan)));
  EXPECT_FALSE(is_usable(robot, tip_setpoint({{nan, 0.0, 0.0}, tip.quaternion})));
  EXPECT_FALSE(is_usable(robot, tip_setpoint({tip.position_m, {2.0, 0.0, 0.0, 0.0}})));
  JointVector joint = micro::radians(micro::kBent_deg);
  EXPECT_TRUE(is_usable(robot, joint_setpoint(joint)));
  joint[6] = robot.joint[6].high_rad + 1e-9;
  EXPECT_FALSE(is_usable(robot, joint_setpoint(joint)));
  joint[6] = nan;
  EXPECT_FALSE(is_usable(robot, joint_setpoint(joint)));
  Setpoint hold = joint_setpoint(joint);
  hold.kind = CommandKind::kHold;
  EXPECT_TRUE(is_usable(robot, hold));
}

}  // namespace
}  // namespace liana::serial
