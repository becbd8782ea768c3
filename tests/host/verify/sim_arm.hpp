// An arm without buses: the Controller behind its link, with ideal drives that start at the prepare pose.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/payout.hpp"
#include "host/control/tick_core.hpp"
#include "host/verify/nominal_drives.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana {

using namespace cable;

class SimArm {
 public:
  SimArm()
      : table_(zhu2022::table()),
        link(table_),
        core_(table_, link),
        drives_(table_, start_inputs().drive, cable::Outputs{}) {
    report_.boot = BootPhase::kDone;
    link.report.publish(report_);
    link.report.refresh();
    link.image.refresh();
  }

  const cable::RobotTable& table() const { return table_; }
  const cable::Outputs& now() const { return outputs_; }
  std::uint64_t ticks_done() const { return report_.next_tick; }

  void tick() {
    cable::Inputs inputs = drives_.next_inputs(report_.next_tick);
    outputs_ = core_.step(inputs);
    report_.inputs = inputs;
    drives_.command(outputs_);
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
  cable::Inputs start_inputs() const {
    cable::Inputs inputs;
    const cable::CableLayout layout = cable_layout(table_);
    const cable::CableGeometry geometry =
        cable_geometry(table_, layout, arm_trig(table_, zhu2022::radians(zhu2022::kPrepare_deg)));
    for (std::size_t i = 0; i < zhu2022::kCables; ++i) {
      const double zero_payout_m = layout.zero_length_m[i] + table_.lead_m;
      DriveFeedback& drive = inputs.drive[i];
      drive.statusword = 0x0250;
      drive.operational = 1;
      drive.position_counts =
          to_counts(counts_at_payout(table_.drive[i], zero_payout_m, geometry.length_m[i] + table_.lead_m)).value;
    }
    return inputs;
  }

  cable::RobotTable table_;

 public:
  ArmLink<cable::CableArm> link;

 private:
  TickCore<cable::CableArm> core_;
  NominalDrives<cable::CableArm> drives_;
  ArmReport<cable::CableArm> report_{};
  cable::Outputs outputs_{};
};

}  // namespace liana
