// The drives on their buses: booted, heard and commanded, whatever arm they move.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware_like/safety/cycle_inputs.hpp"
#include "host/bus/drive_bus.hpp"
#include "host/canopen/master.hpp"
#include "host/config/config.hpp"
#include "host/control/boot_problem.hpp"

namespace liana::control {

enum class BootPhase : std::uint8_t { kBooting = 0, kDone = 1, kFailed = 2 };

class DriveLine {
 public:
  // Setup: may allocate and throw. `bus` must outlive this.
  DriveLine(const std::vector<canopen::DriveExpectation>& drives, const config::BusesConfig& buses, bus::DriveBus& bus);

  // Everything that came in since the last tick, into the inputs of this one; what did not come grows older.
  void collect(const timing::TickStart& start, CycleInputs& inputs) noexcept;
  // Heartbeat out; while booting, the next SDO requests.
  void step_master() noexcept { master_.step(bus_); }
  // Targets to every drive that may still hear them.
  void command(const DriveCommands& commands) noexcept;

  int drive_count() const noexcept { return static_cast<int>(drives_.size()); }
  BootPhase boot_phase() const noexcept;
  // After booting has failed: every drive that is to blame. Not for the real-time thread.
  std::vector<BootProblem> boot_problems() const;
  // After booting: serial number of every drive (0x1018:4), 0 where it has none. They do not change any more. Not for
  // the real-time thread.
  std::vector<std::uint32_t> serials() const;

 private:
  void take_emergencies(CycleInputs& inputs) noexcept;
  std::uint32_t lost_buses() const noexcept;

  bus::DriveBus& bus_;
  std::vector<canopen::DriveExpectation> drives_;  // bus and node of every drive, in the order of the table
  std::vector<std::string> bus_names_;
  canopen::Master master_;
  std::array<std::array<std::int8_t, 128>, bus::kMaxDriveBuses> drive_of_node_{};  // -1: not ours
  std::array<bool, bus::kMaxDriveBuses> has_drives_{};
  std::array<std::uint16_t, bus::kMaxDriveBuses> silent_ticks_{};  // in a row without a report of any drive of the bus
};

}  // namespace liana::control
