// Recordings of hand motion.
#include "host/operator/hand_recording.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static liana::fuzz::MemoryFile file;
  return liana::fuzz::refusing(
      [&] { liana::operator_side::read_hand_recording(file.with(liana::fuzz::text_of(data, size))); });
}
