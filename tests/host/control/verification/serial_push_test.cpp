// What both ends say of a push before it is released, by what the sensors say now. req:B22
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "firmware_like/command/release.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/serial/drive_units.hpp"
#include "host/control/verification/nominal_drives.hpp"
#include "host/control/verification/twin.hpp"
#include "host/control/verification/verify.hpp"
#include "tests/firmware_like/micro_arm.hpp"

namespace liana::verification {
namespace {

using serial::SerialArm;

serial::RobotParams torque_table() {
  serial::RobotParams table = serial::micro::table();
  table.torque.is_torque_controlled = 1;
  table.torque.position_gain_per_s = 2.0;
  table.torque.most_joint_Nm = 100.0;
  table.torque.most_force_N = 60.0;
  table.torque.most_travel_m = 0.2;
  table.torque.most_aside_m = 0.03;
  table.torque.most_turn_rad = 0.05;
  table.torque.gain_high.fill(1e5);
  return table;
}

serial::Setpoint push_with(double force_N) {
  serial::Setpoint setpoint;
  setpoint.kind = CommandKind::kPush;
  setpoint.push.number = 1;
  setpoint.push.force_N = force_N;
  setpoint.push.travel_m = 0.06;
  setpoint.push.aside_m = 0.02;
  setpoint.push.turn_rad = 0.05;
  setpoint.push.gains = {500, 100, 3200, 3000, 1500, 1, 3000, 900, 0.0035, 400};
  return setpoint;
}

// The arm enabled and standing, ideal drives, and sensors that say what they are told to.
class PushTwin {
 public:
  PushTwin() : controller_(table_) {
    for (std::size_t i = 0; i < table_.joints(); ++i) {
      const serial::JointVector joint = serial::micro::radians(serial::micro::kBent_deg);
      image_.last_inputs.drive[i].position_counts = to_counts(serial::counts_at_joint(table_.drive[i], joint[i])).value;
      image_.last_inputs.drive[i].statusword = 0x0250;
      image_.last_inputs.drive[i].operational = 1;
    }
    says_.wrist.age_ticks = 0;
    for (int i = 0; i < 60; ++i) tick(Request::kNone, {});
    tick(Request::kEnable, {});
    for (int i = 0; i < 200; ++i) tick(Request::kNone, {});
    EXPECT_EQ(image_.last_outputs.state, OperatingState::kEnabled);
  }

  // Presses for so many intervals, unverified; the sensors of the last tick say `at_last`.
  void press(const serial::Setpoint& setpoint, int intervals, const std::function<void(serial::Sensors&)>& at_last) {
    for (int i = 0; i < intervals; ++i) {
      tick(Request::kNone, Release::make(++sequence_, now_, now_ + 5, 1, setpoint));
      for (int k = 0; k < 3; ++k) tick(Request::kNone, {});
      if (i + 1 == intervals) at_last(says_);
      tick(Request::kNone, {});
    }
  }
  // The joint stands so far behind its target.
  void lag(std::size_t joint, double by_rad) {
    const double counts = by_rad / table_.drive[joint].rad_per_count;
    for (int k = 0; k < 10; ++k) {  // slowly, or it would jump
      image_.last_inputs.drive[joint].position_counts -= to_counts(counts / 10.0).value;
      tick(Request::kNone, {});
    }
  }
  // One tick without a command, in which the sensors say `what`.
  void hear(const std::function<void(serial::Sensors&)>& what) {
    what(says_);
    tick(Request::kNone, {});
  }

  // Of the execution, else of the motion, else "passed".
  std::string verdict(const serial::Setpoint& setpoint) {
    IssueStep<SerialArm> release;
    image_.controller = controller_;
    image_.next_tick = now_;
    for (std::uint64_t i = 0; i < sequence_; ++i) release.candidate(setpoint, 1, now_, 5);  // those of before
    const Candidate<SerialArm> candidate = release.candidate(setpoint, 1, now_, 5);
    Prediction<SerialArm> prediction;
    Twin<SerialArm>::run(image_, {}, candidate, max_stop_ticks(table_.tick_s), prediction);
    const ExecutionVerdict execution = judge_execution<SerialArm>(table_, candidate, prediction);
    const SimulationVerdict motion = judge_motion<SerialArm>(table_, candidate, prediction);
    if (!execution.passed()) return execution.text;
    return motion.passed() ? "passed" : motion.text;
  }

 private:
  void tick(Request request, const Telecommand<serial::Setpoint>& command) {
    NominalDrives<SerialArm> drives(table_, image_.last_inputs);
    serial::Inputs inputs = drives.next_inputs(now_++, image_.last_outputs);
    for (DriveFeedback& drive : inputs.drive) drive.feedback_age_ticks = 0;
    ++says_.wrist.sequence;
    inputs.sensors = says_;
    inputs.request = request;
    inputs.telecommand = command;
    image_.last_outputs = controller_.tick(inputs);
    image_.last_inputs = inputs;
  }

  serial::RobotParams table_ = torque_table();
  Controller<SerialArm> controller_;
  TwinSnapshot<SerialArm> image_{table_};
  serial::Sensors says_{};
  std::uint64_t now_ = 1;
  std::uint64_t sequence_ = 0;
};

void nothing(serial::Sensors&) {}

TEST(PushTwin, APushWithinTheTableIsReleasedFromRestAndInTheMiddleOfItsWay) {
  PushTwin arm;
  EXPECT_EQ(arm.verdict(push_with(30.0)), "passed");
  arm.press(push_with(30.0), 100, nothing);
  EXPECT_EQ(arm.verdict(push_with(30.0)), "passed");
}

// Where an ideal drive would be at its target at once, that would look like an encoder that jumps.
TEST(PushTwin, JointsThatAreWellBehindTheirTargetsAreNoReasonToRefuse) {
  PushTwin arm;
  serial::Setpoint there;
  there.kind = CommandKind::kJoint;
  there.joint_rad = serial::micro::radians(serial::micro::kBent_deg);
  arm.lag(3, 0.02);
  EXPECT_EQ(arm.verdict(there), "passed");
}

TEST(PushTwin, OneOutsideTheTableIsRefused) {
  PushTwin arm;
  EXPECT_NE(arm.verdict(push_with(60.1)).find("command_invalid"), std::string::npos);
  serial::Setpoint far = push_with(30.0);
  far.push.travel_m = 0.21;
  EXPECT_NE(arm.verdict(far).find("command_invalid"), std::string::npos);
}

TEST(PushTwin, WithASensorThatHasFailedNothingIsReleased) {
  PushTwin arm;
  arm.hear([](serial::Sensors& s) { s.wrist.status = serial::WristStatus::kFailed; });
  EXPECT_NE(arm.verdict(push_with(30.0)).find("wrist_sensor_lost"), std::string::npos);
}

TEST(PushTwin, AForceOverTheTablesShowsAsTheFaultThatItWouldBe) {
  PushTwin arm;
  arm.press(push_with(30.0), 60, [](serial::Sensors& s) { s.wrist.on_arm.force_N = {0.0, 0.0, -70.0}; });
  EXPECT_NE(arm.verdict(push_with(30.0)).find("insert_overload"), std::string::npos);
}

}  // namespace
}  // namespace liana::verification
