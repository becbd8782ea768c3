// A Controller out of a recording's image with bytes changed, run on Inputs with bytes changed: nothing of a damaged
// file may harm the core. The input says which bytes.
#include <cstring>
#include <vector>

#include "host/storage/recording/replay_core.hpp"
#include "tests/firmware_like/micro_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

constexpr std::size_t kEditBytes = 10;  // where, and eight bytes
constexpr int kTicks = 3;

// Takes one edit from the front; the place counts round the end.
void edit(std::string& bytes, std::string_view& rest) {
  std::uint16_t place = 0;
  std::memcpy(&place, rest.data(), sizeof place);
  for (std::size_t i = 0; i < 8; ++i) bytes[(place + i) % bytes.size()] = rest[2 + i];
  rest.remove_prefix(kEditBytes);
}

template <class Arm>
struct Recorded {
  explicit Recorded(const typename Arm::Table& table)
      : packet(recording::image_packet<Arm>(0, Controller<Arm>(table))), counts(recording::counts_of(table)) {
    recording::append_recorded(inputs, Inputs<Arm>{}, counts);
  }
  const std::string packet;
  const recording::RecordedCounts counts;
  std::string inputs;
};

template <class Arm>
void replay(const Recorded<Arm>& good, std::size_t edits_of_image, std::string_view rest) {
  std::string image = good.packet.substr(1), inputs = good.inputs;
  for (; edits_of_image > 0 && rest.size() >= kEditBytes; --edits_of_image) edit(image, rest);
  while (rest.size() >= kEditBytes) edit(inputs, rest);
  recording::ReplayCore<Arm> core(recording::parse_image<Arm>(image), "snapshots.mcap");
  for (int i = 0; i < kTicks; ++i) core.tick(inputs);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Recorded<cable::CableArm> kCable(cable::zhu2022::table());
  static const Recorded<serial::SerialArm> kSerial(serial::micro::table());
  std::string_view rest = fuzz::text_of(data, size);
  const unsigned which = fuzz::choice(rest);
  return fuzz::refusing([&] {
    if (which % 2 == 0) {
      replay(kCable, which / 2 % 8, rest);
    } else {
      replay(kSerial, which / 2 % 8, rest);
    }
  });
}
