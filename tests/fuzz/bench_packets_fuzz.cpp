// What the bench is told: packets of liana-bus, and messages of lianad to the tool at the tip.
#include "hil/arm/tip_tool.hpp"
#include "hil/bus/packets.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view bytes = fuzz::text_of(data, size);
  const unsigned which = fuzz::choice(bytes) % 3;
  const bench::Packet packet(bytes.begin(), bytes.end());
  return fuzz::refusing([&] {
    if (which == 0) bench::read_welcome(packet);
    if (which == 1) bench::read_wake(packet);
    if (which == 2) bench::tool_command(std::string(bytes));
  });
}
