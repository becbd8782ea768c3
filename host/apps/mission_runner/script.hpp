// One Lua state with capped memory and instructions. A good message is its aim; the bound is the watchdog
// (watchdog.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <memory>
#include <string>
#include <vector>

#include "host/apps/mission_runner/activity.hpp"
#include "host/apps/mission_runner/script_files.hpp"

namespace liana::mission_runner {

// What a script may use up.
struct ScriptLimits {
  std::size_t memory_bytes = 64u << 20;
  std::int64_t instructions = 20'000'000;  // in one call from outside, about a quarter of a second
  std::size_t printed_bytes = 256u << 10;  // in all; what goes beyond is left out, and that is said
};

// A Lua state that holds the sandbox (sandbox.hpp) and nothing else.
class Script {
 public:
  // `activity` is told where the script is; it must outlive the script.
  Script(const ScriptLimits& limits, const LuaFolders& lua_folders, Activity& activity);
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  lua_State* state() const { return state_; }

  // Runs a file in a fresh environment and leaves its one result on the stack; what it requires may lie in its folder.
  // Throws std::runtime_error with the script's message.
  void run(const ScriptFile& file);
  // Leaves the result of `require name` on the stack. Throws as run does.
  void require(const std::string& name);
  // Calls the function under `arguments` arguments with a fresh instruction budget. Throws as run does.
  void call(int arguments, int results);

  // Accounting of one script; the hook and the allocator find it through the state.
  struct Budget {
    ScriptLimits limits;
    std::size_t memory_used = 0;
    std::int64_t instructions_used = 0;
    std::size_t printed_bytes = 0;
    Activity* activity = nullptr;
    LuaFolders lua_folders;
    std::string beside;             // folder of the script that was run
    std::vector<ScriptFile> files;  // what was read from there, the script first
  };
  const std::vector<ScriptFile>& files() const { return budget_.files; }

 private:
  Budget budget_;
  lua_State* state_ = nullptr;
};

// Of Lua, for the engine: attempt(function, ...) is pcall, and after an error the script's budgets are whole again, so
// that what has to follow a failure can be done. Returns true and the results, or false and a text.
int attempt(lua_State* state);

// The accounting of the script that runs in this state (or in a coroutine of it).
Script::Budget& script_budget(lua_State* state);

}  // namespace liana::mission_runner
