// Frames from drives into the CANopen master, tick by tick.
#include <cstring>

#include "host/drives/canopen/master.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/host/drives/bus/fake_drive.hpp"
#include "tests/host/drives/bus/quiet_bus.hpp"

using namespace liana;

namespace {

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
  test::QuietBus bus(2);
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
