// One Lua state with capped memory and instructions. A good message is its aim; the bound is the watchdog
// (watchdog.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <memory>
#include <string>

#include "host/lua/activity.hpp"
#include "host/lua/script_files.hpp"

namespace liana::script {

// What a script may use up.
struct ScriptLimits {
  std::size_t memory_bytes = 64u << 20;
  std::int64_t instructions = 20'000'000;  // in one call from outside, about a quarter of a second
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

  // Runs a file in a fresh environment and leaves its one result on the stack. Throws std::runtime_error with the
  // script's message.
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
    Activity* activity = nullptr;
    LuaFolders lua_folders;
  };

 private:
  Budget budget_;
  lua_State* state_ = nullptr;
};

// The accounting of the script that runs in this state (or in a coroutine of it).
Script::Budget& script_budget(lua_State* state);

}  // namespace liana::script
