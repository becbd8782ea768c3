// The real-time side of lianad: one tick against the buses.
#pragma once

#include <string>
#include <vector>

#include "host/bus/drive_bus.hpp"
#include "host/canopen/master.hpp"
#include "host/config/config.hpp"
#include "host/control/boot_problem.hpp"
#include "host/control/tick_core.hpp"

namespace liana {

class RtCycle {
 public:
  // Setup: may allocate and throw. `bus` and `link` must outlive this.
  RtCycle(const RobotConfig& robot, const BusesConfig& buses, DriveBus& bus, Link& link);

  // Waits for the next deadline and runs one tick; false when the other side of the bus has left. After construction
  // nothing here allocates, waits for a lock, or makes a system call that the bus and the timer do not need.
  bool run_tick() noexcept;

  // After booting has failed: every drive that is to blame. Not for the real-time thread.
  std::vector<BootProblem> boot_problems() const;
  // After booting: serial number of every drive (0x1018:4), 0 where it has none. They do not change any more. Not for
  // the real-time thread.
  std::vector<std::uint32_t> serials() const;

 private:
  void collect(const TickStart& start) noexcept;
  void take_emergencies() noexcept;
  std::uint32_t lost_buses() const noexcept;
  void command_drives(const Outputs& outputs) noexcept;
  void count_overrun(const TickStart& start) noexcept;
  void finish_tick(const TickStart& start) noexcept;

  RobotTable table_;
  DriveBus& bus_;
  std::vector<canopen::DriveExpectation> drives_;  // bus and node of every drive, in the order of the cables
  std::vector<std::string> bus_names_;
  std::uint64_t half_period_us_, period_us_;
  canopen::Master master_;
  TickTiming& timing_;
  TickCore core_;
  std::array<std::array<std::int8_t, 128>, kMaxDriveBuses> drive_of_node_{};  // -1: not ours
  std::array<bool, kMaxDriveBuses> has_drives_{};
  std::array<std::uint16_t, kMaxDriveBuses> silent_ticks_{};  // in a row without a report of any drive of the bus
  Inputs inputs_{};
  CycleReport report_{};
  std::uint64_t began_us_ = 0, heard_us_ = 0,
                ended_us_ = 0;  // of the last tick, on the bus's clock; heard: the wait for feedback is over
};

}  // namespace liana
