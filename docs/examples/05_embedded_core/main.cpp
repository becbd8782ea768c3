// The core in a program of one's own: a table built without JSON, drives that do what they are told, one motion.
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "firmware_like/cable_controller.hpp"
#include "firmware_like/command/release.hpp"
#include "firmware_like/drive/ideal_drive.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cable {
namespace {

// Two segments of eight modules with three cables each, ticked every 4 ms, no friction and no weight.
RobotParams two_segments() {
  RobotParams robot;
  robot.segment_count = 2;
  for (std::size_t m = 0; m < 2; ++m) {
    robot.segment[m] = {8, 3, 0.1, 20.0 * kDegree, 0.0, {}};
    robot.segment[m].hole_radius_m = 0.025;
    robot.segment[m].face_offset_m = 0.010;
    for (std::size_t c = 0; c < 3; ++c)
      robot.segment[m].cable_phase_rad[c] = (24.0 * static_cast<double>(m) + 120.0 * static_cast<double>(c)) * kDegree;
  }
  robot.cable_EA_N = 240000.0;
  robot.lead_m = 0.5;
  robot.servo_time_constant_s = 0.03;
  robot.tick_s = 0.004;
  robot.interval_ticks = 5;
  robot.tension = {40.0, 15.0, 1.0, 150.0, 400.0, 600.0};
  robot.limits = {2.0 * kDegree,  4.0 * kDegree,   0.10, 0.03, 0.2, 2.0, 20.0 * kDegree,
                  40.0 * kDegree, 400.0 * kDegree, 0.010};
  for (DriveParams& drive : robot.drive) drive = {2.0 * kPi * 0.015 / 65536.0, 1, 1000000, 0.6};
  return robot;
}

// Drives that are switched off, every cable at its zero: the arm is straight, and nothing pulls.
DriveFeedbacks switched_off(const RobotParams& robot) {
  DriveFeedbacks drives{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(robot.cable_count()); ++c) {
    drives[c].position_counts = robot.drive[c].zero_counts;
    drives[c].statusword = 0x0250;  // CiA 402: switch on disabled
    drives[c].operational = 1;
  }
  return drives;
}

// Enables the arm, bends it, and says whether it stands where it was told to.
bool move() {
  const RobotParams robot = two_segments();
  Controller controller(robot);
  Inputs inputs;
  inputs.drive = switched_off(robot);
  Setpoint goal;
  goal.kind = CommandKind::kJoint;
  goal.joint_rad = {5.0 * kDegree, 0.0, -5.0 * kDegree, 3.0 * kDegree};
  Outputs out;
  for (std::uint64_t tick = 1; tick <= 4000; ++tick) {
    inputs.tick = tick;
    inputs.request = tick == 60 ? Request::kEnable : Request::kNone;
    inputs.telecommand = tick == 1500 ? Release::make(1, tick, tick + 100000, 1, goal) : Telecommand{};
    out = controller.tick(inputs);
    for (std::size_t c = 0; c < static_cast<std::size_t>(robot.cable_count()); ++c) {
      const auto torque = static_cast<std::int16_t>(out.tension_plan_N[c] / robot.drive[c].newtons_per_permille);
      inputs.drive[c] = ideal_feedback(inputs.drive[c], out.drive[c], torque);
    }
  }
  double error_rad = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    error_rad = std::fmax(error_rad, std::fabs(out.theta_measured_rad[i] - goal.joint_rad[i]));
  std::printf("%s, %d faults, largest error %.4f deg\n",
              out.state == OperatingState::kEnabled ? "enabled" : "not enabled", out.faults.count, error_rad / kDegree);
  return out.faults.count == 0 && error_rad < 0.1 * kDegree;
}

}  // namespace
}  // namespace liana::cable

int main() { return liana::cable::move() ? 0 : 1; }
