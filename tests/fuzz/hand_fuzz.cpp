// Recordings of hand motion.
#include <sstream>

#include "host/operator/simulated/hand_recording.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(liana::fuzz::text_of(data, size)));
  return liana::fuzz::refusing([&] { liana::simulated::parse_hand_recording(stream, "fuzz.hand"); });
}
