// An arm without buses: the Controller behind its link, with ideal drives that start at a pose of the test's choice.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/serial/drive_units.hpp"
#include "host/control/realtime/tick_core.hpp"
#include "host/control/verification/nominal_drives.hpp"
#include "tests/firmware_like/micro_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::verification {

// What a drive shows that is switched on and waits, at this position.
inline DriveFeedback waiting_drive(std::int32_t position_counts) {
  DriveFeedback drive;
  drive.statusword = 0x0250;
  drive.operational = 1;
  drive.position_counts = position_counts;
  return drive;
}

// The cable arm's drives at the prepare pose.
inline DriveFeedbacks drives_at_start(const cable::RobotParams& table) {
  DriveFeedbacks drives{};
  const cable::CableLayout layout = cable_layout(table);
  const cable::CableGeometry geometry =
      cable_geometry(table, layout, arm_trig(table, cable::zhu2022::radians(cable::zhu2022::kPrepare_deg)));
  for (std::size_t i = 0; i < cable::zhu2022::kCables; ++i) {
    const double zero_payout_m = layout.zero_length_m[i] + table.lead_m, payout_m = geometry.length_m[i] + table.lead_m;
    drives[i] = waiting_drive(to_counts(counts_at_payout(table.drive[i], zero_payout_m, payout_m)).value);
  }
  return drives;
}

// The small arm's drives at these joint angles.
inline DriveFeedbacks drives_at(const serial::RobotParams& table, const serial::JointVector& joint_rad) {
  DriveFeedbacks drives{};
  for (std::size_t i = 0; i < table.joints(); ++i)
    drives[i] = waiting_drive(to_counts(counts_at_joint(table.drive[i], joint_rad[i])).value);
  return drives;
}

template <class Arm>
class ArmWithoutBuses {
 public:
  ArmWithoutBuses(const typename Arm::Table& table, const DriveFeedbacks& drives)
      : table_(table), link(table_), core_(table_, link), drives_(table_, inputs_with(drives)) {
    report_.boot = realtime::BootPhase::kDone;
    link.report.publish(report_);
    link.report.refresh();
    link.image.refresh();
  }

  const typename Arm::Table& table() const { return table_; }
  const Outputs<Arm>& now() const { return outputs_; }
  std::uint64_t ticks_done() const { return report_.next_tick; }

  void tick() {
    Inputs<Arm> inputs = drives_.next_inputs(report_.next_tick, outputs_);
    outputs_ = core_.step(inputs);
    report_.inputs = inputs;
    ++report_.next_tick;
    core_.publish(report_);
  }
  void interval() {
    for (std::int32_t i = 0; i < table_.interval_ticks; ++i) tick();
    link.report.refresh();
    link.image.refresh();
  }
  // Runs until the arm is enabled; false when it does not get there.
  bool enable() {
    for (int i = 0; i < 10; ++i) interval();
    link.requests.push(Request::kEnable);
    for (int i = 0; i < 500 && outputs_.state != OperatingState::kEnabled; ++i) interval();
    return outputs_.state == OperatingState::kEnabled;
  }

 private:
  static Inputs<Arm> inputs_with(const DriveFeedbacks& drives) {
    Inputs<Arm> inputs;
    inputs.drive = drives;
    return inputs;
  }

  typename Arm::Table table_;

 public:
  realtime::ArmMailbox<Arm> link;

 private:
  realtime::TickCore<Arm> core_;
  NominalDrives<Arm> drives_;
  realtime::ArmTickStatus<Arm> report_{};
  Outputs<Arm> outputs_{};
};

// The cable arm at its prepare pose.
struct SimArm : ArmWithoutBuses<cable::CableArm> {
  SimArm() : ArmWithoutBuses(cable::zhu2022::table(), drives_at_start(cable::zhu2022::table())) {}
};

// The small arm at these joint angles.
struct SimSerialArm : ArmWithoutBuses<serial::SerialArm> {
  explicit SimSerialArm(const serial::JointVector& joint_rad)
      : ArmWithoutBuses(serial::micro::table(), drives_at(serial::micro::table(), joint_rad)) {}
};

}  // namespace liana::verification
