// The CANopen master of all drives: boot, heartbeats both ways, emergencies. Process data pass it by.
//
// Per tick: for each received frame `if (!master.on_frame(...)) { TPDO or foreign }`, then `master.step(bus, tick)`.
#pragma once

#include "host/drives/canopen/boot_sequence.hpp"
#include "host/drives/canopen/emergency.hpp"
#include "host/drives/canopen/heartbeat.hpp"
#include "host/drives/canopen/mode_monitor.hpp"

namespace liana::canopen {

class Master {
 public:
  // Node ids, buses and rate come from the tables; setup only, may throw.
  Master(const std::vector<ExpectedDrive>& drives, const config::BusesConfig& buses);

  // True when the frame was the master's business (boot-up, heartbeat, emergency, SDO response).
  bool on_frame(int bus, const bus::CanFrame& frame, std::uint64_t tick) noexcept;
  // Once per tick, after the frames of the tick: heartbeat out, ages up, next SDO requests of the boot. Bit i of
  // `in_operation`: drive i is in Operation enabled, and asked for its mode.
  void step(bus::DriveBus& bus, std::uint32_t in_operation = 0) noexcept;
  // Somebody wants a booted drive back (clear): BootNode::recover, by what is heard of it. `reports`: its TPDO comes.
  void recover(std::size_t drive, std::uint8_t node, bool reports) noexcept;
  // NMT command to all drives of all buses, as kNmtStop.
  static void command_all(bus::DriveBus& bus, std::uint8_t nmt_command) noexcept;

  const BootSequence& boot() const noexcept { return boot_; }
  const HeartbeatMonitor& heartbeats() const noexcept { return monitor_; }
  const ModeMonitor& modes() const noexcept { return modes_; }
  EmergencyLog& emergencies() noexcept { return emergencies_; }

 private:
  BootSequence boot_;
  HeartbeatProducer producer_;
  HeartbeatMonitor monitor_;
  EmergencyLog emergencies_;
  ModeMonitor modes_;
};

}  // namespace liana::canopen
