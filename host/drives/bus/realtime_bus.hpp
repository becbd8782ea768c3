// What SocketCAN and the embedded bus in real time share: deadlines on the clock, sockets that are polled.
#pragma once

#include <poll.h>

#include "host/base/clock/tick_clock.hpp"
#include "host/drives/bus/bus_entry.hpp"

namespace liana::bus {

class RealtimeBus : public DriveBus {
 public:
  explicit RealtimeBus(std::uint32_t period_us) noexcept : clock_(period_us) {}

  timing::TimeMode time_mode() const noexcept override { return timing::TimeMode::kReal; }
  timing::TickStart begin_tick(std::uint64_t tick) noexcept override;
  void wait_feedback(int expected_tpdos) noexcept override;
  bool receive(ReceivedFrame& received) noexcept override { return book_.fetch(received); }
  void end_tick() noexcept override { flush(); }
  const DriveBusStats& stats(int bus) const noexcept override { return book_.stats(bus); }
  std::uint64_t now_us() const noexcept override { return clock_.now_us(); }

 protected:
  // Takes in what the sockets hold, without waiting.
  virtual void drain() noexcept = 0;
  // Hands over what send() has only queued.
  virtual void flush() noexcept = 0;
  // True when no further frame can come.
  virtual bool ended() const noexcept = 0;
  void watch(int descriptor) noexcept;
  BusEntry& book() noexcept { return book_; }
  const BusEntry& book() const noexcept { return book_; }

 private:
  bool any_failed() const noexcept;

  timing::TickClock clock_;
  BusEntry book_;
  std::array<pollfd, kMaxDriveBuses> watched_{};
  nfds_t watched_count_ = 0;
};

}  // namespace liana::bus
