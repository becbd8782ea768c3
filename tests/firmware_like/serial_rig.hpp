// A Controller of the small arm and ideal drives, ticked together.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "firmware_like/command/release.hpp"
#include "firmware_like/drive/ideal_drive.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/serial_controller.hpp"
#include "tests/firmware_like/micro_arm.hpp"

namespace liana::serial::micro {

constexpr std::uint64_t kForever = 1000000;  // a tick after the end of every test
constexpr std::uint32_t kOwner = 1;

struct Rig {
  explicit Rig(const JointVector& joint_rad = radians(kBent_deg)) : controller(robot) {
    for (std::size_t i = 0; i < robot.joints(); ++i) {
      drive[i].position_counts = to_counts(counts_at_joint(robot.drive[i], joint_rad[i])).value;
      drive[i].statusword = 0x0250;  // switch on disabled
      drive[i].feedback_age_ticks = drive[i].heartbeat_age_ticks = 0;
      drive[i].operational = 1;
    }
  }

  const Outputs& tick(Request request = Request::kNone, const Telecommand& telecommand = {}) {
    Inputs inputs;
    inputs.tick = now++;
    inputs.request = request;
    inputs.telecommand = telecommand;
    inputs.drive = drive;
    out = controller.tick(inputs);
    for (std::size_t i = 0; i < robot.joints(); ++i) drive[i] = ideal_feedback(drive[i], out.drive[i], 0);
    return out;
  }
  void run(std::int32_t ticks) {
    for (std::int32_t i = 0; i < ticks; ++i) tick();
  }
  void enable() {
    run(60);
    tick(Request::kEnable);
    run(100);
    ASSERT_EQ(out.state, OperatingState::kEnabled);
    ASSERT_EQ(out.faults.count, 0);
  }
  Telecommand release(const Setpoint& setpoint, std::uint64_t life_ticks = kForever) {
    return Release::make(++sequence, now, now + life_ticks, kOwner, setpoint);
  }
  Setpoint tip_by(const Vec3& move_m) const {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_in_base = out.tip_command;
    setpoint.tip_in_base.position_m = add(setpoint.tip_in_base.position_m, move_m);
    setpoint.tip_speed_m_s = robot.tip.speed_m_s;
    return setpoint;
  }
  Setpoint joints(const JointVector& joint_rad) const {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    setpoint.joint_rad = joint_rad;
    return setpoint;
  }
  Setpoint only(CommandKind kind) const {
    Setpoint setpoint;
    setpoint.kind = kind;
    return setpoint;
  }

  RobotParams robot = table();
  Controller controller;
  DriveFeedbacks drive{};
  Outputs out{};
  std::uint64_t now = 1;
  std::uint64_t sequence = 0;
};

// True when `out` lists this fault, of whatever drive or bus.
inline bool has_fault(const Outputs& out, FaultNumber number) {
  for (std::int32_t i = 0; i < out.faults.count; ++i) {
    if (out.faults.fault[static_cast<std::size_t>(i)].number == number) return true;
  }
  return false;
}

// The numbers of an Outputs that runs are compared by.
inline std::vector<double> numbers(const Outputs& out) {
  std::vector<double> all{static_cast<double>(out.tick),
                          static_cast<double>(out.limits),
                          static_cast<double>(out.state),
                          static_cast<double>(out.stop_category),
                          static_cast<double>(out.active_sequence),
                          static_cast<double>(out.faults.count),
                          static_cast<double>(out.at_rest),
                          static_cast<double>(out.homed),
                          out.tip_speed_m_s,
                          out.tip_rate_rad_s,
                          out.ik_position_error_m,
                          out.ik_attitude_error_rad};
  for (const DriveCommand& drive : out.drive) {
    all.insert(all.end(), {static_cast<double>(drive.controlword), static_cast<double>(drive.target_counts)});
  }
  for (const Pose& pose : {out.tip_goal, out.tip_command}) {
    all.insert(all.end(), pose.position_m.begin(), pose.position_m.end());
    all.insert(all.end(), pose.quaternion.begin(), pose.quaternion.end());
  }
  for (const JointVector& v :
       {out.joint_command_rad, out.joint_rate_rad_s, out.joint_measured_rad, out.torque_measured_Nm}) {
    all.insert(all.end(), v.begin(), v.end());
  }
  all.insert(all.end(), out.ik_residual.begin(), out.ik_residual.end());
  return all;
}

}  // namespace liana::serial::micro
