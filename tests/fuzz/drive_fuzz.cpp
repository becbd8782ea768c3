// Frames from a master into a drive of the bench: NMT, SDO, PDO, SYNC, heartbeats, and time between them.
#include <algorithm>

#include "hil/drive/drive.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bench::DriveSettings settings;
  settings.node = 5;
  bench::Drive drive(settings, 1000.0);
  bench::FrameList out;
  std::uint64_t now_us = 0;
  for (std::string_view rest = fuzz::text_of(data, size); rest.size() >= 12; rest.remove_prefix(12)) {
    bench::CanFrame frame;
    frame.id = static_cast<std::uint32_t>(static_cast<unsigned char>(rest[0]) |
                                          (static_cast<unsigned char>(rest[1]) & 7u) << 8);
    frame.length = static_cast<std::uint8_t>(static_cast<unsigned char>(rest[2]) % 9u);
    std::copy_n(rest.begin() + 4, 8, frame.data.begin());
    frame.time_us = now_us;
    drive.receive(frame, out);
    now_us += 1000u * static_cast<unsigned char>(rest[3]);
    drive.tick(now_us, out);
    drive.move(0.001, 50.0);
    out.clear();
  }
  return 0;
}
