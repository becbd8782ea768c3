// JSON files: robot, buses, scene and drive type tables, and what their canonical form is read as again.
#include "host/config/config.hpp"
#include "host/json/json.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text = fuzz::text_of(data, size);
  const unsigned which = fuzz::choice(text) % 4;
  return fuzz::refusing([&] {
    const char* kind = which == 0 ? "robot" : which == 1 ? "buses" : which == 2 ? "scene" : "drive";
    const std::string canonical = config::check_table(kind, Json::parse(text), kind);
    if (which == 2) config::parse_scene(canonical, "scene");
  });
}
