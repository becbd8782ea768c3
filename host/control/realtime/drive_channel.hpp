// The drives on their buses: booted, heard and commanded, whatever arm they move.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/safety/cycle_inputs.hpp"
#include "host/control/realtime/boot_problem.hpp"
#include "host/control/realtime/latest_value.hpp"
#include "host/control/realtime/sensor_channel.hpp"
#include "host/drives/bus/drive_bus.hpp"
#include "host/drives/canopen/master.hpp"
#include "host/model/config/config.hpp"

namespace liana::realtime {

// Why drives did not boot; as the real-time thread shows it to others.
struct BootRefusals {
  struct OfDrive {
    std::array<canopen::BootMismatch, canopen::kMaxMismatches> mismatch{};
    std::size_t count = 0;
    std::uint32_t more = 0;
  };
  std::array<OfDrive, kMaxDrives> drive{};
};

enum class BootPhase : std::uint8_t { kBooting = 0, kDone = 1, kFailed = 2 };

class DriveChannel {
 public:
  // Setup: may allocate and throw. `bus` must outlive this.
  DriveChannel(const std::vector<canopen::ExpectedDrive>& drives, const config::BusesConfig& buses, bus::DriveBus& bus);

  // Everything that came in since the last tick, into the inputs of this one; what did not come grows older.
  void collect(const timing::TickStart& start, CycleInputs& inputs) noexcept;
  // What nodes that are no drives have said until now.
  const SensorChannel& sensor_channel() const noexcept { return sensor_line_; }
  // Starts sensors that are not operational, and tells the adapter what it was asked for last.
  void step_sensors(std::uint64_t tick, serial::AdapterCommand command, std::uint8_t sequence) noexcept {
    sensor_line_.step(bus_, tick, command, sequence);
  }
  // Heartbeat out; while booting, the next SDO requests.
  void step_master() noexcept;
  // Before faults are cleared, in every tick until it is true: drives that are silent, left operational or did not boot
  // are booted again. True: there is nothing to wait for, or they have had five seconds. No drive may have torque.
  bool reboot_lost_drives(const CycleInputs& inputs) noexcept;
  // Targets to every drive that may still hear them.
  void command(const DriveCommands& commands) noexcept;

  int drive_count() const noexcept { return static_cast<int>(drives_.size()); }
  BootPhase boot_phase() const noexcept;
  // After booting has failed: every drive that is to blame. For one thread beside the real-time thread.
  std::vector<BootProblem> boot_problems();
  // After booting: serial number of every drive (0x1018:4), 0 where it has none. They do not change any more. Not for
  // the real-time thread.
  std::vector<std::uint32_t> serials() const;
  // After booting: what nobody watches, one line a drive and thing. Not for the real-time thread.
  std::vector<std::string> unwatched() const;

 private:
  int drive_at(int bus, canopen::FrameRoute route) const noexcept {
    return drives_of_node_[static_cast<std::size_t>(bus)][route.node][route.axis - 1U];
  }
  void take_rate(int bus, const bus::CanFrame& frame, CycleInputs& inputs) noexcept;
  void take_report(int bus, std::size_t drive, const bus::CanFrame& frame, CycleInputs& inputs) noexcept;
  std::uint32_t drives_heard_twice(const timing::TickStart& start) noexcept;
  void take_emergencies(CycleInputs& inputs) noexcept;
  std::uint32_t lost_buses() const noexcept;
  void publish_refusals() noexcept;
  std::string names_of_node(std::size_t drive) const;

  bus::DriveBus& bus_;
  std::vector<canopen::ExpectedDrive> drives_;  // bus and node of every drive, in the order of the table
  std::vector<std::string> bus_names_;
  canopen::Master master_;
  SensorChannel sensor_line_;
  LatestValue<BootRefusals> refusals_{BootRefusals{}};  // since booting failed last
  canopen::BootState boot_seen_ = canopen::BootState::kRunning;
  std::uint32_t max_bring_back_ticks_;
  std::uint32_t bring_back_ticks_ = 0;
  std::uint64_t bring_back_tick_ = 0;                      // the last one in which somebody wanted them back
  using DrivesOfNode = std::array<int, config::kMaxAxes>;  // by axis; -1: not ours
  std::array<std::array<DrivesOfNode, 128>, bus::kMaxDriveBuses> drives_of_node_{};
  // Who speaks under the identifiers of a drive: two nodes of one id, or another master.
  struct Voices {
    std::optional<std::array<std::uint8_t, 8>> report;  // its first of this tick
    bool is_another = false;                            // so does somebody else, in this tick
    std::uint16_t ticks = 0;                            // in a row in which he did
  };
  std::array<Voices, kMaxDrives> voices_{};
  std::array<bool, kMaxDrives> has_cell_{};  // the cable of a drive has a load cell
  std::uint32_t in_operation_ = 0;           // bit i: drive i says so in this tick
  std::array<bool, bus::kMaxDriveBuses> has_drives_{};
  std::array<std::uint16_t, bus::kMaxDriveBuses> silent_ticks_{};  // in a row without a report of any drive of the bus
};

}  // namespace liana::realtime
