// Raw CAN sockets (vcan or real interfaces), one per bus.
#pragma once

#include <string>
#include <vector>

#include "hil/bus/bus.hpp"
#include "hil/bus/socket.hpp"

namespace liana::bench {

class SocketCanBus final : public Bus {
 public:
  // Throws std::runtime_error when the kernel has no CAN or an interface is missing or down.
  SocketCanBus(const std::vector<std::string>& interfaces, std::uint32_t period_us);

  bool wait(Wake& wake) override;
  void send(const FrameList& frames) override;
  bool lockstep() const override { return false; }
  std::uint32_t period_us() const override { return period_us_; }
  std::uint64_t refused() const override { return refused_; }

 private:
  std::vector<Socket> sockets_;
  std::uint32_t period_us_;
  std::uint64_t start_us_;
  std::uint64_t refused_ = 0;
};

}  // namespace liana::bench
