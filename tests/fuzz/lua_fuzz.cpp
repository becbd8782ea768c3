// Lua tables: a script in its sandbox, then its result as JSON and as a table.
#include "host/config/config.hpp"
#include "host/json/json.hpp"
#include "host/lua/json_bridge.hpp"
#include "host/lua/script.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static script::Activity activity;
  constexpr script::ScriptLimits kLimits{4u << 20, 20000, 0};
  return fuzz::refusing([&] {
    script::Script script(kLimits, {}, activity);
    script.run({.display = "fuzz.lua", .folder = "", .text = std::string(fuzz::text_of(data, size))});
    const Json result = script::to_json(script.state(), -1, "fuzz.lua");
    script::push_in_protection(script, result);
    config::check_table("scene", result, "fuzz.lua");
  });
}
