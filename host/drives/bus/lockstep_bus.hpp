// The embedded bus in fast and paced time: the bus process owns the clock, this end computes when it is woken.
#pragma once

#include <memory>

#include "host/drives/bus/bus_entry.hpp"
#include "host/drives/bus/embedded_link.hpp"

namespace liana::bus {

class LockstepBus final : public DriveBus {
 public:
  explicit LockstepBus(std::unique_ptr<EmbeddedLink> link);
  ~LockstepBus() override;

  int bus_count() const noexcept override { return link_->welcome().bus_count; }
  timing::TimeMode time_mode() const noexcept override {
    return static_cast<timing::TimeMode>(link_->welcome().time_mode);
  }
  timing::TickStart begin_tick(std::uint64_t tick) noexcept override;
  SendResult send(int bus, const CanFrame& frame) noexcept override;
  // Always half a period: virtual time costs nothing, and a constant moment keeps runs repeatable.
  void wait_feedback(int expected_tpdos) noexcept override;
  bool receive(ReceivedFrame& received) noexcept override { return book_.fetch(received); }
  void end_tick() noexcept override;
  const DriveBusStats& stats(int bus) const noexcept override { return book_.stats(bus); }
  std::uint64_t now_us() const noexcept override { return now_us_; }

 private:
  timing::TickStart skip_passed(std::uint64_t tick) noexcept;
  void yield_until(std::uint64_t until_us) noexcept;
  void wait_wake() noexcept;
  void end() noexcept;

  std::unique_ptr<EmbeddedLink> link_;
  BusEntry book_;
  wire::Yield yield_;
  wire::Wake wake_;
  std::array<int, kMaxDriveBuses> queued_{};  // frames of this yield per bus
  std::uint64_t period_us_;
  std::uint64_t tick_ = 0;
  std::uint64_t now_us_ = 0;
  bool awake_ = false;  // woken and not yet yielded
  bool ended_ = false;
};

}  // namespace liana::bus
