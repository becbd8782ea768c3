// Scenarios: scripts of bus faults, and fault lists of the bench.
#include "hil/config/fault_config.hpp"
#include "host/bus_sim/fault_script.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile file;
  std::string_view text = fuzz::text_of(data, size);
  const bool is_of_bus = fuzz::choice(text) % 2 == 0;
  const std::string& path = file.with(text);
  return fuzz::refusing([&] {
    if (is_of_bus) {
      bus_sim::load_fault_script(path, 2);
    } else {
      bench::load_faults(path, 15, 10);
    }
  });
}
