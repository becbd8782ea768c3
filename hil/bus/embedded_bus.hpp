// Client of liana-bus as the plant: lockstep in fast and paced time, free-running in real time.
#pragma once

#include <string>

#include "hil/bus/bus.hpp"
#include "hil/bus/packets.hpp"
#include "hil/bus/socket.hpp"

namespace liana::bench {

class EmbeddedBus final : public Bus {
 public:
  // Connects (waiting up to 10 s for the bus to appear) and says HELLO; throws std::runtime_error when that fails or
  // when the bus has another period or number of buses than the table.
  EmbeddedBus(const std::string& socket_path, std::uint32_t period_us, std::size_t bus_count);

  bool wait(Wake& wake) override;
  void send(const FrameList& frames) override;
  bool lockstep() const override { return welcome_.time_mode != 2; }
  std::uint32_t period_us() const override { return welcome_.period_us; }
  std::uint64_t refused() const override { return refused_; }

 private:
  bool read(Packet& packet, int timeout_ms);
  void write(const Packet& packet);

  Socket socket_;
  Welcome welcome_;
  std::uint32_t slot_ = 0;
  std::uint64_t now_us_ = 0;
  std::uint64_t wall_at_now_us_ = 0;
  std::uint64_t refused_ = 0;
  bool has_begun_ = false;  // it was woken once: the bus has a time
  bool ended_ = false;
};

}  // namespace liana::bench
