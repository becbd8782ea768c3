// What a serial arm carries, on its way into setpoints.
#include "host/control/arbiter/serial_arbiter.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/micro_arm.hpp"

namespace liana::arbiter {
namespace {

TEST(SerialArbiter, WhatTheArmCarriesIsInEverySetpointUntilAnotherIsTold) {
  const serial::RobotParams table = serial::micro::table();
  SerialArbiter arbiter(table);
  SerialArbiter::Now now{};
  now.state = OperatingState::kEnabled;
  now.at_rest = 1;
  now.joint_command_rad = now.joint_measured_rad = {0.1, 0.6, -0.2, 1.1, 0.3, 0.8, -0.1};
  now.tip_command = serial::forward_kinematics(table, now.joint_command_rad).tip_in_base;
  std::uint64_t tick = 100;
  const auto carried_kg = [&] { return arbiter.next_setpoint(tick += 5, now)->payload_at_tip.mass_kg; };

  serial::JointVector goal = now.joint_command_rad;
  goal[0] += 0.5;
  arbiter.move_joints(now, goal, 0.05);
  EXPECT_EQ(carried_kg(), 0.0);
  const serial::LinkMass payload{500.0, {0.0, 0.0, 0.5}, {80.0, 80.0, 80.0, 0.0, 0.0, 0.0}};
  arbiter.carry(payload, {});
  EXPECT_EQ(carried_kg(), 500.0);
  EXPECT_EQ(arbiter.next_setpoint(tick += 5, now)->payload_at_tip.center_m, payload.center_m);
  arbiter.carry({}, {});
  EXPECT_EQ(carried_kg(), 0.0);
}

}  // namespace
}  // namespace liana::arbiter
