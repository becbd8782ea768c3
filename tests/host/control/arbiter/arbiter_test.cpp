// The arbiter of every arm, here of a serial one: it chooses between the ways of moving.
#include "host/control/arbiter/arbiter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "host/api/server/request_error.hpp"
#include "host/control/arbiter/serial_traits.hpp"
#include "tests/firmware_like/micro_arm.hpp"

namespace liana::arbiter {
namespace {

using serial::JointVector;

class SerialArbitration : public testing::Test {
 protected:
  SerialArbitration() {
    now_.state = OperatingState::kEnabled;
    stand_at({0.1, 0.6, -0.2, 1.1, 0.3, 0.8, -0.1});
  }
  void stand_at(const JointVector& joint_rad) {
    now_.at_rest = 1;
    now_.joint_command_rad = joint_rad;
    now_.tip_command = serial::forward_kinematics(table_, joint_rad).tip_in_base;
  }
  std::optional<serial::Setpoint> next() { return arbiter_.next_setpoint(tick_ += 5, now_); }
  static std::string code_of(const std::function<void()>& request) {
    try {
      request();
    } catch (const api::RequestError& error) {
      return error.code();
    }
    return "accepted";
  }

  serial::RobotParams table_ = serial::micro::table();
  Arbiter<serial::SerialArm> arbiter_{table_};
  liana::Outputs<serial::SerialArm> now_{};
  std::uint64_t tick_ = 0;
};

TEST_F(SerialArbitration, AJointMoveKeepsRateAndAccelerationOfEveryJointAndEndsAtItsGoal) {
  JointVector goal = now_.joint_command_rad;
  goal[1] += 0.4;
  goal[6] -= 0.1;
  arbiter_.move_joints(now_, goal, 1.0);
  EXPECT_EQ(code_of([&] { arbiter_.servo_tip(now_, now_.tip_command); }), "busy");
  const double dt_s = interval_s(table_);
  double fastest = 0.0;
  JointVector last = now_.joint_command_rad, last_rate{};
  while (arbiter_.is_busy()) {
    const auto setpoint = next();
    ASSERT_TRUE(setpoint);
    ASSERT_EQ(setpoint->kind, CommandKind::kJoint);
    for (std::size_t i = 0; i < table_.joints(); ++i) {
      const double rate = (setpoint->joint_rad[i] - last[i]) / dt_s;
      fastest = std::max(fastest, std::fabs(rate) / table_.joint[i].rate_rad_s);
      EXPECT_LE(std::fabs(rate - last_rate[i]) / dt_s, table_.joint[i].accel_rad_s2);
      last_rate[i] = rate;
    }
    last = setpoint->joint_rad;
  }
  EXPECT_EQ(last, goal);
  EXPECT_LE(fastest, 1.0);
  EXPECT_GT(fastest, 0.2) << "and not idle";
}

TEST_F(SerialArbitration, ALineEndsAtItsGoalWhichIsAskedForUntilTheTipIsThere) {
  Pose goal = now_.tip_command;
  goal.position_m[2] += 0.02;
  arbiter_.move_line(now_, goal);
  EXPECT_TRUE(arbiter_.is_busy());
  std::optional<serial::Setpoint> setpoint;
  while (arbiter_.is_busy()) setpoint = next();
  for (int i = 0; i < 50; ++i) setpoint = next();
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->tip_in_base.position_m, goal.position_m);
  now_.tip_command = goal;
  EXPECT_FALSE(next());
}

TEST_F(SerialArbitration, AServoGoalTakesTheLastOnesPlace) {
  Pose goal = now_.tip_command;
  for (int i = 0; i < 3; ++i) {
    goal.position_m[0] += 0.001;
    arbiter_.servo_tip(now_, goal);
    EXPECT_EQ(next()->tip_in_base.position_m, goal.position_m);
  }
}

TEST_F(SerialArbitration, TheWayBackLeadsAlongWhatWasCommanded) {
  const JointVector start = now_.joint_command_rad;
  next();
  for (int i = 0; i < 20; ++i) {
    now_.joint_command_rad[0] += 0.001;
    next();
  }
  arbiter_.retract(now_, 0);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(next()) << "it comes to rest first";
  for (auto setpoint = next(); setpoint; setpoint = next()) now_.joint_command_rad = setpoint->joint_rad;
  EXPECT_EQ(now_.joint_command_rad, start);
  EXPECT_TRUE(arbiter_.has_retracted());
  EXPECT_FALSE(arbiter_.is_busy());
}

TEST_F(SerialArbitration, AHoldAndARefusalEndAMove) {
  JointVector goal = now_.joint_command_rad;
  goal[1] += 0.4;
  arbiter_.move_joints(now_, goal, 1.0);
  arbiter_.hold();
  EXPECT_FALSE(next());
  arbiter_.move_joints(now_, goal, 1.0);
  EXPECT_TRUE(next());
  arbiter_.refused();
  EXPECT_FALSE(next());
}

TEST_F(SerialArbitration, NothingMovesUnlessEnabled) {
  now_.state = OperatingState::kDisabled;
  EXPECT_EQ(code_of([&] { arbiter_.move_joints(now_, {}, 1.0); }), "not_enabled");
  EXPECT_EQ(code_of([&] { arbiter_.retract(now_, 0); }), "not_enabled");
  EXPECT_FALSE(next());
}

}  // namespace
}  // namespace liana::arbiter
