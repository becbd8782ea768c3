// Lua tables: a script in its sandbox, then its result as JSON, as a table of its kind, and in Lua again.
#include <memory>

#include "host/apps/mission_runner/json_bridge.hpp"
#include "host/apps/mission_runner/script.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

// Small: what a script may do besides, a string of megabytes a thousand times, says nothing new and takes a second.
constexpr mission_runner::ScriptLimits kLimits{1u << 20, 4000, 0};
constexpr int kScriptsOfOneState = 200;

// Every script has an environment of its own, as scripts that one evaluation runs have; so one state serves many. What
// ran out of its budget takes the state along.
class State {
 public:
  mission_runner::Script& next() {
    if (!script_ || ++scripts_ > kScriptsOfOneState) {
      script_.reset();
      script_ = std::make_unique<mission_runner::Script>(kLimits, mission_runner::LuaFolders{}, activity_);
      scripts_ = 0;
    }
    lua_settop(script_->state(), 0);
    return *script_;
  }
  bool has_run_out() const {
    const mission_runner::Script::Budget& budget = mission_runner::script_budget(script_->state());
    return budget.instructions_used > kLimits.instructions || budget.memory_used > kLimits.memory_bytes / 2;
  }
  void give_up() { script_.reset(); }

 private:
  mission_runner::Activity activity_;
  std::unique_ptr<mission_runner::Script> script_;
  int scripts_ = 0;
};

}  // namespace

// The state that is kept would be searched for after every script.
extern "C" int __lsan_is_turned_off() { return 1; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static State states;
  std::string_view text = fuzz::text_of(data, size);
  const char* kind = fuzz::choice(text) % 2 == 0 ? "scene" : "drive";
  mission_runner::Script& script = states.next();
  fuzz::refusing([&] {
    script.run({.display = "fuzz.lua", .text = std::string(text), .folder = ""});
    const Json result = mission_runner::to_json(script.state(), -1, "fuzz.lua");
    mission_runner::push_in_protection(script, result);
    config::check_table(kind, result, "fuzz.lua");
  });
  if (states.has_run_out()) states.give_up();
  return 0;
}
