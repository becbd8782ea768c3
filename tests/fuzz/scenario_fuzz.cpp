// Scenarios: scripts of bus faults.
#include "host/drives/bus_simulator/fault_script.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return liana::fuzz::refusing(
      [&] { liana::bus_simulator::parse_fault_script(std::string(liana::fuzz::text_of(data, size)), "script", 2); });
}
