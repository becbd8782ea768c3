// The visual servo as a way of moving, of a serial arm.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "host/api/server/request_error.hpp"
#include "host/control/arbiter/arbiter.hpp"
#include "host/control/arbiter/serial_traits.hpp"
#include "tests/firmware_like/micro_arm.hpp"
#include "tests/message.hpp"

namespace liana::arbiter {
namespace {

using visual_servo::ServoPhase;

// An arm that stands still, whatever it is asked for, and a camera that sees the target where the tip should be, or
// `off_m` farther along its x.
class ServoMoves : public testing::Test {
 protected:
  ServoMoves() {
    now_.state = OperatingState::kEnabled;
    now_.at_rest = 1;
    now_.joint_command_rad = now_.joint_measured_rad = {0.1, 0.6, -0.2, 1.1, 0.3, 0.8, -0.1};
    now_.tip_command = serial::forward_kinematics(table_, now_.joint_command_rad).tip_in_base;
    request_.target = "adapter";
    request_.place = {{-0.2, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  }
  std::optional<serial::Setpoint> next(double off_m, bool seen = true) {
    tick_ += 5;
    const double capture_s = (static_cast<double>(tick_) - 1.0) * table_.tick_s - 0.1;
    if (seen) arbiter_.see_target("adapter", capture_s, {{0.2 + off_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}});
    return arbiter_.next_setpoint(tick_, now_);
  }
  std::string refusal_of(const std::function<void()>& request) {
    try {
      request();
    } catch (const api::RequestError& error) {
      return error.code();
    }
    return "accepted";
  }

  serial::RobotParams table_ = serial::micro::table();
  Arbiter<serial::SerialArm> arbiter_{table_};
  visual_servo::ServoRequest request_;
  liana::Outputs<serial::SerialArm> now_{};
  std::uint64_t tick_ = 100;
};

TEST_F(ServoMoves, ItIsAPlannedMoveOfTipSetpointsThatEndsByItself) {
  for (int i = 0; i < 10; ++i) next(0.0);
  arbiter_.servo_target(now_, request_);
  EXPECT_TRUE(arbiter_.is_busy());
  EXPECT_EQ(refusal_of([&] { arbiter_.servo_tip(now_, now_.tip_command); }), "busy");
  for (int i = 0; i < 20; ++i) {
    const auto setpoint = next(0.0);
    ASSERT_TRUE(setpoint);
    EXPECT_EQ(setpoint->kind, CommandKind::kTip);
  }
  for (int i = 0; i < 100; ++i) next(0.0);
  EXPECT_EQ(arbiter_.servo_report().phase, ServoPhase::kDone);
  EXPECT_FALSE(arbiter_.is_busy());
  EXPECT_FALSE(next(0.0)) << "the arm holds";
}

TEST_F(ServoMoves, NothingIsAskedToMoveBeforeTheTargetIsSeen) {
  arbiter_.servo_target(now_, request_);
  for (int i = 0; i < 20; ++i) {
    const auto setpoint = next(0.0, false);
    ASSERT_TRUE(setpoint);
    EXPECT_EQ(setpoint->tip_in_base.position_m, now_.tip_command.position_m);
  }
  for (int i = 0; i < 60; ++i) next(0.0, false);
  EXPECT_EQ(arbiter_.servo_report().phase, ServoPhase::kLost);
  EXPECT_FALSE(arbiter_.is_busy());
}

TEST_F(ServoMoves, IsNoFasterThanTheArmMayBe) {
  for (int i = 0; i < 10; ++i) next(0.0);
  request_.limits.speed_m_s = request_.limits.accel_m_s2 = 1.0;
  arbiter_.servo_target(now_, request_);
  Vec3 last = now_.tip_command.position_m;
  double fastest_m_s = 0.0;
  for (int i = 0; i < 100; ++i) {
    const auto setpoint = next(0.5);
    ASSERT_TRUE(setpoint);
    now_.tip_command = setpoint->tip_in_base;  // done at once, and measured where it was: always as far to go
    fastest_m_s = std::max(fastest_m_s, norm(subtract(setpoint->tip_in_base.position_m, last)) / interval_s(table_));
    last = setpoint->tip_in_base.position_m;
  }
  EXPECT_NEAR(fastest_m_s, table_.tip.speed_m_s, 1e-6);
}

struct End {
  const char* reason;
  std::function<void(Arbiter<serial::SerialArm>&)> by;
};

TEST_F(ServoMoves, WhatEndsItIsTold) {
  const End ends[] = {{"held", [](auto& arbiter) { arbiter.hold(); }},
                      {"refused: 206 unreachable", [](auto& arbiter) { arbiter.refused("206 unreachable"); }}};
  for (const End& end : ends) {
    arbiter_.servo_target(now_, request_);
    next(0.1);
    end.by(arbiter_);
    EXPECT_EQ(arbiter_.servo_report().phase, ServoPhase::kStandby);
    EXPECT_EQ(arbiter_.servo_report().reason, end.reason);
    EXPECT_FALSE(arbiter_.is_busy());
  }
}

TEST_F(ServoMoves, AnArmThatIsNotEnabledIsNotLed) {
  arbiter_.servo_target(now_, request_);
  now_.state = OperatingState::kDisabled;
  EXPECT_FALSE(next(0.0));
  EXPECT_TRUE(names(arbiter_.servo_report().reason, {"enabled"}));
  EXPECT_EQ(refusal_of([&] { arbiter_.servo_target(now_, request_); }), "not_enabled");
}

}  // namespace
}  // namespace liana::arbiter
