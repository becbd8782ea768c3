// What every back end keeps per bus: counters, received frames, and how much feedback this tick has brought.
#pragma once

#include <array>

#include "host/bus/drive_bus.hpp"
#include "host/bus/rx_ring.hpp"

namespace liana {

class BusBook {
 public:
  // A new tick: no feedback yet.
  void begin_tick() noexcept { feedback_ = 0; }
  // PDO frames (0x181..0x1FF) stored since begin_tick().
  int feedback() const noexcept { return feedback_; }
  // Counts and stores a received frame.
  void store(int bus, const CanFrame& frame) noexcept;
  // Counts a frame handed to the bus.
  void count_sent(int bus, const CanFrame& frame) noexcept;
  // Counts an own frame that did not fit the transmit queue; `was_counted` when it had been counted as sent.
  void count_refused(int bus, const CanFrame& frame, bool was_counted) noexcept;
  bool fetch(ReceivedFrame& received) noexcept { return ring_.pop(received); }
  DriveBusStats& stats(int bus) noexcept { return stats_[static_cast<std::size_t>(bus)]; }
  const DriveBusStats& stats(int bus) const noexcept { return stats_[static_cast<std::size_t>(bus)]; }

 private:
  RxRing ring_;
  std::array<DriveBusStats, kMaxDriveBuses> stats_{};
  int feedback_ = 0;
};

}  // namespace liana
