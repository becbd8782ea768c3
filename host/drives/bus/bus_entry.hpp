// What every back end keeps per bus: counters, received frames, and how much feedback this tick has brought.
#pragma once

#include <array>

#include "host/drives/bus/bus_protocol.hpp"
#include "host/drives/bus/drive_bus.hpp"
#include "host/drives/bus/rx_ring.hpp"

namespace liana::bus {

class BusEntry {
 public:
  // A new tick: no feedback yet.
  void begin_tick() noexcept { feedback_ = 0; }
  // PDO frames (0x181..0x1FF, and of second axes 0x381..0x3FF) stored since begin_tick().
  int feedback() const noexcept { return feedback_; }
  // Counts and stores a received frame; an error frame is counted and changes the state of the bus (linux/can/error.h).
  void store(int bus, const CanFrame& frame) noexcept;
  // Counts a frame handed to the bus.
  void count_sent(int bus, const CanFrame& frame) noexcept;
  // Counts an own frame that did not fit the transmit queue; `was_counted` when it had been counted as sent.
  void count_refused(int bus, const CanFrame& frame, bool was_counted) noexcept;
  // A record of the embedded bus: a frame, an own one that was refused, or a change of the link.
  void take_record(const wire::Frame& record) noexcept;
  bool fetch(ReceivedFrame& received) noexcept { return ring_.pop(received); }
  DriveBusStats& stats(int bus) noexcept { return stats_[static_cast<std::size_t>(bus)]; }
  const DriveBusStats& stats(int bus) const noexcept { return stats_[static_cast<std::size_t>(bus)]; }

 private:
  void note_error_frame(DriveBusStats& book, const CanFrame& frame) noexcept;

  RxRing ring_;
  std::array<DriveBusStats, kMaxDriveBuses> stats_{};
  int feedback_ = 0;
};

}  // namespace liana::bus
