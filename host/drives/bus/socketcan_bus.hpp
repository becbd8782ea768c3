// Raw CAN sockets, one per interface.
#pragma once

#include "host/drives/bus/realtime_bus.hpp"

namespace liana::bus {

class SocketCanBus final : public RealtimeBus {
 public:
  // Throws std::runtime_error: kernel without CAN, interface missing, not CAN, down, or with too short a transmit
  // queue.
  explicit SocketCanBus(const config::BusesConfig& config);
  ~SocketCanBus() override;

  int bus_count() const noexcept override { return bus_count_; }
  SendResult send(int bus, const CanFrame& frame) noexcept override;

 private:
  void drain() noexcept override;
  void flush() noexcept override {}
  bool ended() const noexcept override { return false; }  // an interface may come back
  void drain_bus(int bus) noexcept;

  std::array<int, kMaxDriveBuses> descriptor_{};
  int bus_count_ = 0;
};

}  // namespace liana::bus
