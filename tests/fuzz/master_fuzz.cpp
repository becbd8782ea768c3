// Frames from drives into the CANopen master, tick by tick.
#include <cstring>

#include "host/canopen/master.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/host/bus/fake_drive.hpp"

using namespace liana;

namespace {

class SilentBus final : public bus::DriveBus {
 public:
  int bus_count() const noexcept override { return 2; }
  timing::TimeMode time_mode() const noexcept override { return timing::TimeMode::kFast; }
  timing::TickStart begin_tick(std::uint64_t tick) noexcept override { return {tick, 0, 0, false}; }
  bus::SendResult send(int, const bus::CanFrame&) noexcept override { return bus::SendResult::kOk; }
  void wait_feedback(int) noexcept override {}
  bool receive(bus::ReceivedFrame&) noexcept override { return false; }
  void end_tick() noexcept override {}
  const bus::DriveBusStats& stats(int) const noexcept override { return stats_; }
  std::uint64_t now_us() const noexcept override { return 0; }

 private:
  bus::DriveBusStats stats_;
};

config::BusesConfig two_buses() {
  config::BusesConfig buses;
  buses.rate_hz = 250.0;
  buses.buses.resize(2);
  return buses;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const canopen::Master kFresh({test::expectation(0, 1), test::expectation(1, 9)}, two_buses());
  canopen::Master master = kFresh;  // its plan of the boot is the same every time
  SilentBus bus;
  std::uint64_t tick = 0;
  for (std::string_view rest = fuzz::text_of(data, size); rest.size() >= 12; rest.remove_prefix(12)) {
    bus::CanFrame frame;
    frame.id = static_cast<std::uint32_t>(static_cast<unsigned char>(rest[0]) |
                                          (static_cast<unsigned char>(rest[1]) & 7u) << 8);
    frame.length = static_cast<std::uint8_t>(static_cast<unsigned char>(rest[2]) % 9u);
    std::memcpy(frame.data.data(), rest.data() + 4, 8);
    master.on_frame(rest[3] & 1, frame, tick);
    for (int i = 0; i < (rest[3] >> 1 & 7); ++i) {
      master.step(bus);
      ++tick;
    }
  }
  return 0;
}
