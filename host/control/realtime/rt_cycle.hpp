// The real-time side of lianad: one tick against the buses.
#pragma once

#include <string>
#include <vector>

#include "host/control/realtime/drive_channel.hpp"
#include "host/control/realtime/tick_core.hpp"
#include "host/control/realtime/tick_times.hpp"

namespace liana::realtime {

template <class Arm>
class RtCycle {
 public:
  // Setup: may allocate and throw. `drives` in the order of the table; `bus` and `link` must outlive this.
  RtCycle(const typename Arm::Table& table, const std::vector<canopen::ExpectedDrive>& drives,
          const config::BusesConfig& buses, bus::DriveBus& bus, ArmMailbox<Arm>& link);

  // Waits for the next deadline and runs one tick; false when the other side of the bus has left. After construction
  // nothing here allocates, waits for a lock, or makes a system call that the bus and the timer do not need.
  bool run_tick() noexcept;

  // What the service asks about the drives once they are booted, or have not booted.
  DriveChannel& line() { return line_; }

 private:
  void step_sensors(const timing::TickStart& start) noexcept;
  void step_core() noexcept;
  void finish_tick(const timing::TickStart& start) noexcept;

  bus::DriveBus& bus_;
  DriveChannel line_;
  TickTimes times_;
  TickCore<Arm> core_;
  ArmMailbox<Arm>& link_;
  std::uint64_t interval_ticks_;
  ArmTickStatus<Arm> report_{};
};

extern template class RtCycle<cable::CableArm>;
extern template class RtCycle<serial::SerialArm>;

}  // namespace liana::realtime
