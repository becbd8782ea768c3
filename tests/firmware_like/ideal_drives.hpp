// Ideal drives for tests of the whole core: they do what they are told one tick later, on an arm that stands where the
// lengths say.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/cable_controller.hpp"
#include "firmware_like/command/release.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {

// CiA 402 drives without dynamics: targets of the tick before are positions of this one, torque is what the controller
// planned.
class IdealDrives {
 public:
  // Cables pulled as planned at `theta_rad`, drives switched off.
  IdealDrives(const RobotParams& robot, const ThetaVector& theta_rad) : robot_(robot) {
    const CableLayout layout = cable_layout(robot);
    const ArmTrig trig = arm_trig(robot, theta_rad);
    const CableGeometry geometry = cable_geometry(robot, layout, trig);
    const TensionRatio ratio = tension_ratio(robot, layout, trig, SlipState{});
    const CableVector motor_N = plan_at_rest(robot, layout, theta_rad).motor_N;
    const CableVector payout_m = payout_for(robot, layout, geometry.part_m, ratio, motor_N);
    for (std::size_t c = 0; c < count(); ++c) {
      const double zero_m = layout.zero_length_m[c] + robot.lead_m;
      drive_[c].position_counts = to_counts(counts_at_payout(robot.drive[c], zero_m, payout_m[c])).value;
      drive_[c].statusword = 0x0250;  // switch on disabled
      drive_[c].feedback_age_ticks = drive_[c].heartbeat_age_ticks = 0;
      drive_[c].operational = 1;
    }
    pull(motor_N);
  }

  // What the drives report before the tick.
  Inputs inputs(std::uint64_t tick) const {
    Inputs out;
    out.tick = tick;
    out.drive = drive_;
    return out;
  }

  // The outputs arrive and act.
  void act(const Outputs& outputs) {
    for (std::size_t c = 0; c < count(); ++c) {
      DriveFeedback& drive = drive_[c];
      drive.statusword = answer_to(outputs.drive[c].controlword, drive.statusword);
      if (drive.statusword == kEnabled) drive.position_counts = outputs.drive[c].target_counts;
    }
    pull(outputs.tension_plan_N);
  }

  // Stops the feedback of one drive: its age grows with every tick.
  void silence(std::size_t drive) { ++drive_[drive].feedback_age_ticks; }

  // Statusword after a controlword, at once.
  static std::uint16_t answer_to(std::uint16_t controlword, std::uint16_t statusword) {
    if ((controlword & 0x0002) == 0) return 0x0250;       // disable voltage
    if ((controlword & 0x0004) == 0) return 0x0250;       // quick stop: at once, then disabled
    if ((controlword & 0x000F) == 0x0006) return 0x0231;  // shutdown: ready to switch on
    if ((controlword & 0x000F) == 0x0007) return 0x0233;  // switched on
    return statusword == 0x0250 ? statusword : kEnabled;  // enable operation
  }

 private:
  static constexpr std::uint16_t kEnabled = 0x0437;

  std::size_t count() const { return static_cast<std::size_t>(robot_.cable_count()); }

  void pull(const CableVector& motor_N) {
    for (std::size_t c = 0; c < count(); ++c) {
      if (motor_N[c] > 0.0)
        drive_[c].torque_permille =
            narrow<std::int16_t>(to_counts(motor_N[c] / robot_.drive[c].newtons_per_permille).value);
    }
  }

  RobotParams robot_;
  DriveFeedbacks drive_{};
};

constexpr std::uint64_t kForever = 1000000;  // a tick after the end of every test

// A controller and its drives, ticked together.
struct Rig {
  explicit Rig(const ThetaVector& theta = zhu2022::radians(zhu2022::kPrepare_deg)) : Rig(zhu2022::table(), theta) {}
  Rig(const RobotParams& table, const ThetaVector& theta) : robot(table), controller(robot), drives(robot, theta) {}

  const Outputs& tick(Request request = Request::kNone, const Telecommand& telecommand = {}) {
    Inputs inputs = drives.inputs(now++);
    inputs.request = request;
    inputs.telecommand = telecommand;
    out = controller.tick(inputs);
    drives.act(out);
    return out;
  }
  void run(std::int32_t ticks) {
    for (std::int32_t i = 0; i < ticks; ++i) tick();
  }
  void enable() {
    run(60);
    tick(Request::kEnable);
    run(1000);
    ASSERT_EQ(out.state, OperatingState::kEnabled);
    ASSERT_EQ(out.faults.count, 0);
  }
  Telecommand release(const Setpoint& setpoint, std::uint64_t life_ticks = kForever) {
    return Release::make(++sequence, now, now + life_ticks, 1, setpoint);
  }
  Setpoint tip_by(const Vec3& move_m) const {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_in_base = out.tip_command;
    setpoint.tip_in_base.position_m = add(setpoint.tip_in_base.position_m, move_m);
    setpoint.tip_speed_m_s = robot.limits.tip_speed_m_s;
    return setpoint;
  }
  Setpoint joints(const ThetaVector& theta) const {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    setpoint.joint_rad = theta;
    return setpoint;
  }

  RobotParams robot;
  Controller controller;
  IdealDrives drives;
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

// Every number of an Outputs in order, so that runs can be compared field by field.
inline std::vector<double> numbers(const Outputs& out) {
  std::vector<double> all{static_cast<double>(out.tick),
                          static_cast<double>(out.limits),
                          static_cast<double>(out.state),
                          static_cast<double>(out.stop_category),
                          static_cast<double>(out.active_sequence),
                          static_cast<double>(out.faults.count),
                          static_cast<double>(out.at_rest),
                          static_cast<double>(out.homed),
                          static_cast<double>(out.held_mask),
                          out.tip_speed_m_s,
                          out.tip_rate_rad_s,
                          out.ik_position_error_m,
                          out.ik_attitude_error_rad,
                          out.ik_residual[0]};
  for (const DriveCommand& drive : out.drive)
    all.insert(all.end(), {static_cast<double>(drive.controlword), static_cast<double>(drive.target_counts)});
  for (const Pose& pose : {out.tip_goal, out.tip_command}) {
    all.insert(all.end(), pose.position_m.begin(), pose.position_m.end());
    all.insert(all.end(), pose.quaternion.begin(), pose.quaternion.end());
  }
  for (const ThetaVector& v : {out.theta_command_rad, out.theta_rate_rad_s, out.theta_measured_rad})
    all.insert(all.end(), v.begin(), v.end());
  for (const CableVector& v : {out.tension_plan_N, out.tension_measured_N, out.payout_command_m})
    all.insert(all.end(), v.begin(), v.end());
  return all;
}

}  // namespace liana::cable
