// A bus without time and without anybody on it: what is sent is lost, nothing is heard. Tests derive from it and say
// what is otherwise.
#pragma once

#include "host/drives/bus/drive_bus.hpp"

namespace liana::test {

class QuietBus : public bus::DriveBus {
 public:
  explicit QuietBus(int buses) : buses_(buses) {}
  int bus_count() const noexcept override { return buses_; }
  timing::TimeMode time_mode() const noexcept override { return timing::TimeMode::kFast; }
  timing::TickStart begin_tick(std::uint64_t tick) noexcept override { return {tick, 0, 0, false}; }
  bus::SendResult send(int, const bus::CanFrame&) noexcept override { return bus::SendResult::kOk; }
  void wait_feedback(int) noexcept override {}
  bool receive(bus::ReceivedFrame&) noexcept override { return false; }
  void end_tick() noexcept override {}
  const bus::DriveBusStats& stats(int) const noexcept override { return stats_; }
  std::uint64_t now_us() const noexcept override { return 0; }

 private:
  int buses_;
  bus::DriveBusStats stats_;
};

}  // namespace liana::test
