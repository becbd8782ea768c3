// Whether drives that follow targets stay in the mode that they were told (6061): asked by SDO, since a full report has
// no room for it. Nothing allocates after construction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "firmware_like/safety/drive_link_monitor.hpp"
#include "host/drives/bus/drive_bus.hpp"
#include "host/drives/canopen/expected_drive.hpp"
#include "host/drives/canopen/sdo_client.hpp"

namespace liana::canopen {

// Bits per second with worst-case stuffing that asking adds to a bus with so many drives.
double mode_bits_per_s(int drives, double rate_hz);

class ModeMonitor {
 public:
  // Buses that asking would load over their table's max_load are left out. Setup only, may allocate.
  ModeMonitor(const std::vector<ExpectedDrive>& drives, const config::BusesConfig& buses);

  // Once per tick: sends the next requests. Bit i of `in_operation`: drive i is booted and in Operation enabled, as its
  // newest report says.
  void step(bus::DriveBus& bus, std::uint32_t in_operation) noexcept;
  // An SDO response of a node.
  void on_frame(int bus, const bus::CanFrame& frame) noexcept;
  // Bit i: while it was in Operation enabled, drive i showed another mode than its own.
  std::uint32_t other_mode() const noexcept { return other_; }
  // Whether drive i is asked: its type has 6061, its bus has room, and it has not answered that it has none.
  bool is_asked(std::size_t drive) const noexcept { return drives_[drive].is_asked; }
  // Why drive i is not: its bus has no room.
  bool bus_is_full(std::size_t drive) const noexcept { return drives_[drive].bus_is_full; }

 private:
  struct Asked {
    int bus = 0;
    std::uint8_t node = 0;
    std::uint8_t axis = 1;
    std::int8_t mode = 8;
    bool is_asked = true;
    bool bus_is_full = false;
    bool shares_node = false;         // with another axis
    bool was_passed = false;          // its node was busy with another axis when its turn came
    bool counts = false;              // the answer under way was asked for in Operation enabled
    std::uint16_t enabled_ticks = 0;  // in a row in Operation enabled
    SdoClient sdo;
  };
  struct Round {
    std::vector<std::size_t> drives;
    std::size_t next = 0;
    std::size_t credit = 0;
  };

  void take_answer(std::size_t drive) noexcept;
  void ask_next(Round& round, bus::DriveBus& bus) noexcept;
  std::size_t axis_to_ask(std::size_t drive) noexcept;
  static bool may_ask(const Asked& drive) noexcept;

  std::vector<Asked> drives_;
  std::array<Round, bus::kMaxDriveBuses> rounds_{};  // by bus
  std::uint32_t other_ = 0;
};

}  // namespace liana::canopen
