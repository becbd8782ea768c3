// Recordings of ticks: packets of lianad to its archive, and messages of a recording that a replay takes.
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/serialise.hpp"
#include "host/storage/recording/tick_packet.hpp"
#include "host/storage/recording/visit.hpp"
#include "tests/firmware_like/micro_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

template <class Arm>
void read_message(unsigned which, std::string_view bytes, const recording::RecordedCounts& counts) {
  if (which == 0) recording::parse_image<Arm>(bytes);
  if (which == 1) recording::RecordingDecoder::recorded_inputs<Arm>(bytes, counts);
  if (which == 2) recording::outputs_from<Arm>(bytes, counts);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const recording::RecordedCounts kCable = recording::counts_of(cable::zhu2022::table());
  static const recording::RecordedCounts kSerial = recording::counts_of(serial::micro::table());
  std::string_view bytes = fuzz::text_of(data, size);
  const unsigned which = fuzz::choice(bytes) % 7;
  return fuzz::refusing([&] {
    if (which < 3) {
      read_message<cable::CableArm>(which, bytes, kCable);
    } else if (which < 6) {
      read_message<serial::SerialArm>(which - 3, bytes, kSerial);
    } else if (recording::tick_packet_kind(bytes) == recording::TickPacket::kTick) {
      recording::split_tick_packet(bytes);
    }
  });
}
