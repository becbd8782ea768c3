// What the bench reads: its fault lists and the tables in its own words, which come as files.
#include "hil/config/fault_config.hpp"
#include "hil/config/robot_config.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/config/serial_config.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile file;
  std::string_view text = fuzz::text_of(data, size);
  const unsigned which = fuzz::choice(text) % 5;
  const std::string& path = file.with(text);
  if (which == 0) fuzz::refusing([&] { bench::faults_at(7, std::string(text), 15); });
  return fuzz::refusing([&] {
    if (which == 0) bench::load_faults(path, 15, 10);
    if (which == 1) bench::load_robot(path);
    if (which == 2) bench::load_scene(path);
    if (which == 3) bench::load_buses(path);
    if (which == 4) bench::load_serial_robot(path);
  });
}
