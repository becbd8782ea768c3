// JSON files: robot, buses, scene, drive type and budget tables, and what their canonical form is read as again.
#include <array>
#include <string_view>

#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text = fuzz::text_of(data, size);
  constexpr std::array kKinds{"robot", "buses", "scene", "drive", "budget", "campaign"};
  const char* const kind = kKinds[fuzz::choice(text) % kKinds.size()];
  return fuzz::refusing([&] {
    const std::string canonical = config::check_table(kind, Json::parse(text), kind);
    if (std::string_view(kind) == "scene") config::parse_scene(canonical, "scene");
  });
}
